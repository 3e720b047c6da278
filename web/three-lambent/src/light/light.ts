// Distant light as spherical harmonics: what an asset is relit by.

import type { LightProbe, Texture } from "three";
import { bandsOf, coefficientCount, evaluateHarmonics, kMaxBands } from "../sh/basis.js";
import { HarmonicRotation, matrixOfQuaternion } from "../sh/rotation.js";
import { hannWindow, lanczosWindow, minimalRingingWindow } from "../sh/window.js";
import type { Sky } from "../sky/sky.js";
import { addDisc } from "./disc.js";
import { projectEquirectangular, type EquirectangularImage } from "./equirectangular.js";
import { imageOfTexture } from "./texture-pixels.js";

/** A colour: linear, Rec. 709 primaries. */
export type Rgb = readonly [number, number, number];

/** Anything with x, y, z: three's Vector3. */
export interface DirectionLike {
  x: number;
  y: number;
  z: number;
}

/** Anything with x, y, z, w: three's Quaternion. */
export interface QuaternionLike extends DirectionLike {
  w: number;
}

/** A disc far away: of constant radiance, or darker towards its limb and cut by a horizon. */
export interface Disc {
  /** Towards it, away from the scene. Need not be of unit length. */
  direction: DirectionLike;
  /** Angular diameter, radians, 0 … 2π. */
  diameter: number;
  /** Radiance of every point of it, or of its centre. */
  radiance: Rgb;
  /** u, 0 … 1: the radiance is that of the centre · (1 − u (1 − μ)), μ = √(1 − (θ/radius)²). */
  limbDarkening?: Rgb;
  /**
   * It is seen where a direction is at this elevation about `up` or above it. A disc that is cut
   * has a diameter of at most 0.2, or of 2π: that is a ground, with `up` pointing down.
   */
  horizon?: { up: DirectionLike; elevation: number };
}

/** How high bands are attenuated against ringing; W in bands. */
export type WindowName = "none" | "minimal" | `hann:${number}` | `lanczos:${number}`;

function checkBands(bands: number): void {
  if (!Number.isInteger(bands) || bands < 1 || bands > kMaxBands)
    throw new RangeError(`LambentLight: ${bands} bands, where 1 to ${kMaxBands} can be`);
}

/**
 * Light as a function of direction (pointing away from the scene), radiance per linear Rec. 709
 * channel, in n bands of real orthonormal harmonics: polar axis +z, positive signs, index
 * l(l+1)+m. That is also the basis of three's `LightProbe`, of which a light of 3 bands is a copy.
 *
 * Methods that change a light work in place, count up `version`, and return it, so that they chain.
 */
export class LambentLight {
  readonly bands: number;
  /** [coefficient][red, green, blue]. After writing into it, call {@link touch}. */
  readonly coefficients: Float64Array;
  private changes = 0;

  /** Black. @param bands 1 … 10; as many as the asset's are enough */
  constructor(bands = 5) {
    checkBands(bands);
    this.bands = bands;
    this.coefficients = new Float64Array(3 * coefficientCount(bands));
  }

  /** Grows with every change. */
  get version(): number {
    return this.changes;
  }

  /** Says that `coefficients` were written to. */
  touch(): this {
    ++this.changes;
    return this;
  }

  /**
   * @param coefficients bands² rows of [r, g, b], or their 3 · bands² numbers one after the other
   * @throws RangeError if their number is not that of 1 … 10 bands, or one is not finite
   */
  static fromCoefficients(
    coefficients: ArrayLike<number> | ReadonlyArray<ArrayLike<number>>,
  ): LambentLight {
    const nested = typeof coefficients[0] !== "number";
    const flat: number[] = [];
    for (let i = 0; i < coefficients.length; ++i) {
      const row = coefficients[i];
      if (nested) for (let c = 0; c < 3; ++c) flat.push((row as ArrayLike<number>)[c]);
      else flat.push(row as number);
    }
    const bands = bandsOf(flat.length / 3);
    if (!bands)
      throw new RangeError(
        `LambentLight: ${flat.length} numbers are not three for each of 1, 4, 9 … 100 coefficients`,
      );
    if (!flat.every((v) => Number.isFinite(v)))
      throw new RangeError("LambentLight: a coefficient is not a finite number");
    const light = new LambentLight(bands);
    light.coefficients.set(flat);
    return light.touch();
  }

  /**
   * LIGHT.json, as `lambent light` writes it.
   *
   * @throws Error if it is something else
   */
  static fromJson(json: unknown): LambentLight {
    const object = json as { lambent?: unknown; coefficients?: unknown } | null;
    const rows = object?.coefficients;
    if (object?.lambent !== "light" || !Array.isArray(rows))
      throw new Error('LambentLight: is not {"lambent": "light", "coefficients": [[r, g, b], …]}');
    return LambentLight.fromCoefficients(rows);
  }

  /** Three's probe: its coefficients are of radiance in the same basis, times its intensity. */
  static fromLightProbe(probe: LightProbe): LambentLight {
    const light = new LambentLight(3);
    probe.sh.coefficients.forEach((v, i) => {
      light.coefficients[3 * i] = v.x * probe.intensity;
      light.coefficients[3 * i + 1] = v.y * probe.intensity;
      light.coefficients[3 * i + 2] = v.z * probe.intensity;
    });
    return light.touch();
  }

  /**
   * The exact projection of a latitude-longitude map, bilinear between its pixels.
   *
   * @param map a texture whose pixels are in memory (DataTexture; HDRLoader's and EXRLoader's are),
   *   or its pixels
   * @throws Error if the pixels are elsewhere (a render target, a compressed texture)
   */
  static fromEquirectangular(map: Texture | EquirectangularImage, bands = 5): LambentLight {
    checkBands(bands);
    const image = "isTexture" in map ? imageOfTexture(map) : map;
    const light = new LambentLight(bands);
    light.coefficients.set(projectEquirectangular(image, bands));
    return light.touch();
  }

  /** The same radiance from everywhere. */
  static uniform(radiance: Rgb, bands = 5): LambentLight {
    const light = new LambentLight(bands);
    for (let c = 0; c < 3; ++c) light.coefficients[c] = Math.sqrt(4 * Math.PI) * radiance[c];
    return light.touch();
  }

  /** Adds a disc, in closed form. One without extent adds nothing. */
  addDisc({ direction, diameter, ...rest }: Disc): this {
    const { x, y, z } = direction;
    const length = Math.hypot(x, y, z);
    if (!(length > 0) || !(diameter >= 0 && diameter <= 2 * Math.PI * (1 + 1e-12)))
      throw new RangeError(
        `LambentLight: a disc of ${diameter} radians towards (${x}, ${y}, ${z}) cannot be`,
      );
    addDisc(this.coefficients, this.bands, { direction, diameter, ...rest });
    return this.touch();
  }

  /** Adds another light, band by band; bands that this one has not are cut. */
  add(other: LambentLight, factor = 1): this {
    const count = Math.min(this.coefficients.length, other.coefficients.length);
    for (let i = 0; i < count; ++i) this.coefficients[i] += factor * other.coefficients[i];
    return this.touch();
  }

  /** Becomes the light of a sky: dome, ground and Sun. */
  setSky(sky: Sky): this {
    return this.copy(sky.light(this.bands));
  }

  /** Multiplies all radiance. */
  scale(factor: number): this {
    for (let i = 0; i < this.coefficients.length; ++i) this.coefficients[i] *= factor;
    return this.touch();
  }

  /** Becomes another light; bands that it has not are 0, more of them are cut. */
  copy(other: LambentLight): this {
    this.coefficients.fill(0);
    return this.add(other);
  }

  clone(): LambentLight {
    return new LambentLight(this.bands).copy(this);
  }

  /** Turns the light: what stood in direction s stands in q·s. Cheap enough for every frame. */
  rotate(q: QuaternionLike): this {
    const from = this.coefficients.slice();
    new HarmonicRotation(this.bands)
      .set(matrixOfQuaternion(q))
      .apply(from, this.coefficients, this.bands, 3);
    return this.touch();
  }

  /**
   * Attenuates high bands: "hann:W", "lanczos:W" (W > 0, in bands), "minimal" (the least that keeps
   * radiance from falling below zero; some milliseconds), "none".
   *
   * @throws RangeError for another name
   */
  window(name: WindowName): this {
    return name === "none" ? this : this.attenuate(this.windowWeights(name));
  }

  /** Multiplies each band by its weight; bands beyond them stay as they are. */
  attenuate(weights: ArrayLike<number>): this {
    for (let l = 0; l < Math.min(this.bands, weights.length); ++l)
      for (let i = 3 * l * l; i < 3 * (l + 1) * (l + 1); ++i) this.coefficients[i] *= weights[l];
    return this.touch();
  }

  /** What {@link window} multiplies each band with. @throws Error for another name */
  windowWeights(name: WindowName): Float64Array {
    if (name === "none") return new Float64Array(this.bands).fill(1);
    if (name === "minimal") return minimalRingingWindow(this.coefficients, this.bands);
    const match = /^(hann|lanczos):(.+)$/.exec(name);
    const width = Number(match?.[2]);
    if (!match || !(width > 0))
      throw new RangeError(`LambentLight: no window "${name}": hann:W, lanczos:W, minimal or none`);
    return match[1] === "hann" ? hannWindow(this.bands, width) : lanczosWindow(this.bands, width);
  }

  /** The radiance that the harmonics give in a unit direction; negative where they ring. */
  radiance(direction: DirectionLike): [number, number, number] {
    const y = evaluateHarmonics(this.bands, direction.x, direction.y, direction.z);
    const sum: [number, number, number] = [0, 0, 0];
    for (let i = 0; i < y.length; ++i)
      for (let c = 0; c < 3; ++c) sum[c] += this.coefficients[3 * i + c] * y[i];
    return sum;
  }
}
