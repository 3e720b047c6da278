// Aerial perspective: what air does to what is seen through it, L = f L₀ + L_in, for a viewer on the
// ground under a simulated sky. As sky::AirTable, and shaders/aerial_perspective.glsl.

import { DataTexture, FloatType, NearestFilter, RGBAFormat, Vector3 } from "three";
import { AssetAir } from "../asset/asset-air.js";
import type { DirectionLike, Rgb } from "../light/light.js";
import {
  AirData,
  airReach,
  kAirSize,
  kDistancePower,
  kElevationPower,
  type AirTableData,
} from "./air_data.js";
import { cornetteShanks, rayleighPhase } from "./phase_functions.js";
import type { Sky } from "./sky.js";

/** What air between a viewer and a place does to light from there. */
export interface AirBetween {
  /** f, 0 … 1. */
  extinction: [number, number, number];
  /** L_in, W m⁻² sr⁻¹ of luminous equivalent. A channel may be below 0, out of the gamut. */
  inScattered: [number, number, number];
}

const mixed = (a: number, b: number, share: number) => a + share * (b - a);

/** The air under a sky. `dispose` frees its texture. */
export class AerialPerspective {
  /** A row of texels for each distance and elevation. */
  readonly texture: DataTexture;
  /** What the table's sources are multiples of. */
  readonly scale: number;
  /** Of the Sun, as it is seen; radians. */
  readonly sunElevation: number;
  readonly sunAzimuth: number;

  /** @internal Made by LambentAir. */
  constructor(
    /** @internal */ readonly table: AirTableData,
    sky: Sky,
    scale: number,
  ) {
    const { azimuths, elevations, distances } = kAirSize;
    this.texture = new DataTexture(
      table.texels,
      3 * azimuths + 1,
      elevations * distances,
      RGBAFormat,
      FloatType,
    );
    this.texture.magFilter = this.texture.minFilter = NearestFilter;
    this.texture.needsUpdate = true;
    this.scale = scale;
    this.sunElevation = sky.sun.elevation;
    this.sunAzimuth = sky.sun.azimuth;
  }

  /** Of the world in the Sun's frame: x towards the Sun along the horizon, y up. */
  private inSunFrame({ x, y, z }: DirectionLike): Vector3 {
    const [east, south] = [Math.sin(this.sunAzimuth), -Math.cos(this.sunAzimuth)];
    return new Vector3(east * x + south * z, y, east * z - south * x).normalize();
  }

  /** @param metres to what is seen in that direction of the world, of any length but 0 */
  between(direction: DirectionLike, metres: number): AirBetween {
    const d = this.inSunFrame(direction);
    const { radius, height, texels } = this.table;
    const { azimuths, elevations, distances } = kAirSize;
    const half = elevations / 2;
    const elevation = Math.atan2(d.y, Math.hypot(d.x, d.z));
    const above = elevation >= 0;
    const reach = airReach(radius, height, above, d.y);
    const far = Math.min(Math.max(metres, 0), above ? reach : 1e9);
    const taps = (place: number, count: number): [number, number] => {
      const at = Math.min(Math.max(place, 0), 1) * (count - 1);
      const low = Math.min(Math.floor(at), count - 2);
      return [low, at - low];
    };
    const [u, across] = taps(Math.atan2(Math.abs(d.z), d.x) / Math.PI, azimuths);
    const [v, up] = taps((Math.abs(elevation) / (Math.PI / 2)) ** (1 / kElevationPower), half);
    const [w, away] = taps((far / reach) ** (1 / kDistancePower), distances);
    const logs = [0, 0, 0];
    const sources = [0, 1, 2].map(() => [0, 0, 0]);
    for (let corner = 0; corner < 4; ++corner) {
      const [j, k] = [corner & 1, corner >> 1];
      const weight = (j ? up : 1 - up) * (k ? away : 1 - away);
      const row = (w + k) * elevations + v + j + (above ? half : 0);
      const texel = (column: number, c: number) => texels[4 * (row * (3 * azimuths + 1) + column) + c];
      for (let c = 0; c < 3; ++c) {
        logs[c] += weight * texel(3 * azimuths, c);
        for (let s = 0; s < 3; ++s)
          sources[s][c] +=
            weight * mixed(texel(s * azimuths + u, c), texel(s * azimuths + u + 1, c), across);
      }
    }
    const lost = logs.map((log) => -Math.expm1(-far * Math.exp(log)));
    const cosine = d.x * Math.cos(this.sunElevation) + d.y * Math.sin(this.sunElevation);
    const phases = [rayleighPhase(cosine), cornetteShanks(this.table.asymmetry, cosine), 1];
    const scattered = lost.map(
      (share, c) =>
        this.scale * share * phases.reduce((sum, phase, s) => sum + phase * sources[s][c], 0),
    );
    return {
      extinction: lost.map((share) => 1 - share) as [number, number, number],
      inScattered: scattered as [number, number, number],
    };
  }

  /** What is seen of a radiance through so much air. */
  seen(radiance: Rgb, direction: DirectionLike, metres: number): [number, number, number] {
    const { extinction, inScattered } = this.between(direction, metres);
    return extinction.map((f, c) => f * radiance[c] + inScattered[c]) as [number, number, number];
  }

  /**
   * @internal What an asset is seen through it with: who has no air has no part of the package for it.
   */
  forAsset(): AssetAir {
    return new AssetAir();
  }

  dispose(): void {
    this.texture.dispose();
  }
}

/**
 * Makes the air of skies, some milliseconds each: of a viewer on the ground, as the preset "clear" has
 * it, whatever the model of the sky.
 */
export class LambentAir {
  private readonly data: AirData;

  /**
   * @param data the bytes of three-lambent/data/air.bin
   * @throws Error if they are something else
   */
  constructor(data: ArrayBuffer) {
    this.data = new AirData(data);
  }

  /** Fetches the data. @throws Error if there is none at the address */
  static async load(url: string | URL): Promise<LambentAir> {
    const response = await fetch(url);
    if (!response.ok)
      throw new Error(`LambentAir: ${String(url)}: the server answers ${response.status}`);
    return new LambentAir(await response.arrayBuffer());
  }

  under(sky: Sky): AerialPerspective {
    return new AerialPerspective(
      this.data.table(sky.turbidity, sky.sun.elevation),
      sky,
      sky.sun.nearness,
    );
  }
}
