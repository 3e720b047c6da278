// A sky by day and in twilight as a light and as an environment: dome, Sun, ground. As
// lambent/sky/make_sky.cpp and sky_light.cpp.
//
// This work is based on hestroffer1998wavelength: the Sun's limb darkening, here one coefficient a
// channel with the same mean over the disc.

import type { DataTexture } from "three";
import { LambentLight, type DirectionLike, type Disc, type Rgb } from "../light/light.js";
import type { Environment, EnvironmentSky } from "../materials/environment.js";
import { analyticSky, domeOf, type AnalyticModel, type AnalyticSky } from "./analytic_skies.js";
import { shownRgb } from "./color.js";
import { domeTexture, projectDome } from "./dome_light.js";
import { clearSkyIrradiance, measuredSky, type MeasuredModel } from "./measured_skies.js";
import { SkyData } from "./sky_data.js";
import { refraction, sunIrradianceScale, sunPosition, worldDirection } from "./sun_position.js";

/**
 * "fast": the library's simulation of its preset "clear". The others are analytic: Preetham's, CIE's
 * clear sky of 1973, overcast sky, and types "cie:1" … "cie:15" of the standard general sky; and two
 * that know a sky by what weather stations measure, Perez's and ASRC-CIE.
 */
export type SkyModel = "fast" | AnalyticModel | MeasuredModel;

/** Angles in radians. Either date, latitude and longitude say where the Sun stands, or it is told. */
export interface SkyRequest {
  /** A moment: a Date, or milliseconds since 1970 UTC; of 1600 … 2400. */
  date?: Date | number;
  /** North positive. */
  latitude?: number;
  /** East positive. */
  longitude?: number;
  /** Of the disc's centre as it is seen through the air: −18° … 90°. */
  sunElevation?: number;
  /** Compass bearing: north (−z) 0, east (+x) π/2. Default π, the south. */
  sunAzimuth?: number;
  /** Default "fast". */
  model?: SkyModel;
  /** How hazy the air is, 1 (no aerosols) … 10. Default 2.5. */
  turbidity?: number;
  /**
   * What was measured, of "perez" and "asrc-cie" alone: irradiance by the Sun on a surface that faces
   * it, and by the sky on a horizontal one; W m⁻², 0 … 2000. Default: those of a clear sky.
   */
  directNormal?: number;
  diffuseHorizontal?: number;
}

/** The Sun as its own component of a sky. */
export interface SkySun {
  /** As it is seen, radians. */
  elevation: number;
  /** Compass bearing, radians. */
  azimuth: number;
  /** A unit vector towards it in the world. */
  direction: [number, number, number];
  /** On a surface that faces it, of what stands above the horizon; W m⁻² of luminous equivalent. */
  irradiance: Rgb;
  /** Radians. */
  angularRadius: number;
  /** What its light is of that at one astronomical unit. */
  nearness: number;
  /** How much of the disc stands above the horizon, 0 … 1. */
  visible: number;
  /** The same as a disc with its limb darkening; null where none of it is seen. */
  disc: Disc | null;
}

const kNight = (-18 * Math.PI) / 180;
const kSunRadius = 0.004652; // rad, at one astronomical unit
const kAlbedo = 0.1; // of the ground
const kStandardAir = { temperature: 288.15, pressure: 101325 };
const kUp = { x: 0, y: 1, z: 0 };

/** The part of the Sun's disc above a horizon; `height`: its centre's, in radii. */
function discAbove(height: number): number {
  const x = Math.max(-1, Math.min(1, height));
  return 1 - (Math.acos(x) - x * Math.sqrt(1 - x * x)) / Math.PI;
}

/** Irradiance of the ground by a disc of irradiance 1. */
function horizontalShareOfDisc(elevation: number): number {
  const x = Math.max(-1, Math.min(1, elevation / kSunRadius));
  if (x >= 1) return Math.sin(elevation);
  const rest = 1 - x * x;
  return kSunRadius * (x * discAbove(x) + (2 / (3 * Math.PI)) * rest * Math.sqrt(rest));
}

/** u of 1 − u (1 − μ) for light of 610, 550 and 465 nm, whose mean over the disc is that of μ^α. */
const limbDarkening = [0.61, 0.55, 0.465].map((micrometres) => {
  const exponent = -0.023 + 0.292 / micrometres;
  return (3 * exponent) / (exponent + 2);
}) as [number, number, number];

/** ∫ s·axis of a disc whose centre has the radiance 1. */
function irradianceOfDisc(disc: Disc, axis: readonly [number, number, number]): number[] {
  const { coefficients } = new LambentLight(2).addDisc({ ...disc, radiance: [1, 1, 1] });
  const scale = Math.sqrt((4 * Math.PI) / 3);
  const [x, y, z] = axis;
  return [0, 1, 2].map(
    (c) => scale * (y * coefficients[3 + c] + z * coefficients[6 + c] + x * coefficients[9 + c]),
  );
}

/** The sky of one moment. */
export class Sky {
  /** The dome with its horizon, for {@link Environment}; `dispose` frees its texture. */
  readonly dome: EnvironmentSky;
  /** Of what is below the horizon: one radiance, W m⁻² sr⁻¹ of luminous equivalent. */
  readonly ground: Rgb;
  /** The ground as a disc. */
  readonly groundDisc: Disc;
  readonly sun: SkySun;
  readonly turbidity: number;
  private readonly coefficients: Float64Array;

  /** @internal */
  constructor(
    texture: DataTexture,
    coefficients: Float64Array,
    ground: Rgb,
    sun: SkySun,
    turbidity: number,
  ) {
    const half = Math.PI / 4 - sun.azimuth / 2; // about +y, from the Sun's frame to the world
    this.dome = {
      texture,
      horizon: 0,
      rotation: { x: 0, y: Math.sin(half), z: 0, w: Math.cos(half) },
    };
    this.ground = ground;
    this.groundDisc = {
      direction: { x: 0, y: -1, z: 0 },
      diameter: 2 * Math.PI,
      radiance: ground,
      horizon: { up: { x: 0, y: -1, z: 0 }, elevation: 0 },
    };
    this.sun = sun;
    this.turbidity = turbidity;
    this.coefficients = coefficients;
  }

  /** What mirrors and the background show. */
  get environment(): Environment {
    return { texture: null, sky: this.dome, discs: this.discs };
  }
  /** The ground, and the Sun where it is up. */
  get discs(): Disc[] {
    return this.sun.disc ? [this.groundDisc, this.sun.disc] : [this.groundDisc];
  }

  /**
   * Dome, ground and Sun in 1 … 10 bands, or the dome and the ground alone (the Sun may be a light of
   * its own, with a sharp shadow), or the dome alone.
   */
  light(bands = 5, { without }: { without?: "sun" | "discs" } = {}): LambentLight {
    const light = new LambentLight(bands);
    light.coefficients.set(this.coefficients.subarray(0, light.coefficients.length));
    if (without === "discs") return light.touch();
    light.addDisc(this.groundDisc);
    if (this.sun.disc && without !== "sun") light.addDisc(this.sun.disc);
    return light;
  }

  /** Of dome or ground, the Sun left out, towards a direction of any length but 0. */
  radiance({ x, y, z }: DirectionLike): [number, number, number] {
    if (!(y > 0)) return [...this.ground];
    const { data, width, height } = this.dome.texture.image as {
      data: Float32Array;
      width: number;
      height: number;
    };
    // World → the Sun's frame.
    const [east, south] = [Math.sin(this.sun.azimuth), -Math.cos(this.sun.azimuth)];
    const azimuth = Math.atan2(east * z - south * x, east * x + south * z);
    const elevation = Math.atan2(y, Math.hypot(x, z));
    const column = (azimuth / (2 * Math.PI) + 0.5) * width - 0.5;
    const row = Math.sqrt(elevation / (Math.PI / 2)) * (height - 1);
    const [x0, y0] = [Math.floor(column), Math.min(Math.floor(row), height - 2)];
    const out: [number, number, number] = [0, 0, 0];
    for (const i of [0, 1])
      for (const j of [0, 1]) {
        const across = i ? column - x0 : 1 - column + x0;
        const weight = across * (j ? row - y0 : 1 - row + y0);
        const at = 4 * ((y0 + j) * width + ((x0 + i + width) % width));
        for (let c = 0; c < 3; ++c) out[c] += weight * data[at + c];
      }
    return out;
  }

  dispose(): void {
    this.dome.texture.dispose();
  }
}

interface Seen {
  elevation: number;
  azimuth: number;
  /** Astronomical units. */
  distance: number;
}

function seenSun(request: SkyRequest): Seen {
  const { date, latitude, longitude, sunElevation, sunAzimuth } = request;
  if (date === undefined) {
    if (sunElevation === undefined || latitude !== undefined || longitude !== undefined)
      throw new RangeError("LambentSky: give date, latitude and longitude, or sunElevation");
    if (!(Math.abs(sunElevation) <= Math.PI / 2 + 1e-9))
      throw new RangeError(`LambentSky: the Sun's elevation ${sunElevation}: radians, -π/2 to π/2`);
    const azimuth = sunAzimuth ?? Math.PI;
    if (!Number.isFinite(azimuth))
      throw new RangeError(`LambentSky: the Sun's azimuth ${azimuth}: radians`);
    return { elevation: Math.min(sunElevation, Math.PI / 2), azimuth, distance: 1 };
  }
  if (latitude === undefined || longitude === undefined)
    throw new RangeError("LambentSky: a date takes a latitude and a longitude");
  if (sunElevation !== undefined || sunAzimuth !== undefined)
    throw new RangeError("LambentSky: the date says where the Sun stands: tell one of the two");
  const sun = sunPosition(Number(date), latitude, longitude);
  return {
    elevation: Math.min(
      sun.elevation + refraction(sun.elevation, kStandardAir),
      Math.PI / 2,
    ),
    azimuth: sun.azimuth,
    distance: 1 / Math.sqrt(sunIrradianceScale(sun.distance)),
  };
}

const isMeasured = (model: SkyModel): model is MeasuredModel =>
  model === "perez" || model === "asrc-cie";

/** @throws RangeError for a model that is not there, and for what does not go with it */
function checkModel({ model = "fast", directNormal, diffuseHorizontal }: SkyRequest): void {
  if ((model as string) === "exact")
    throw new RangeError(
      "LambentSky: the model exact marches through the air, which takes the tool: lambent sky; here " +
        "fast is nearest to it",
    );
  if (!/^(fast|preetham|perez|asrc-cie|cie-clear|cie-overcast|cie:([1-9]|1[0-5]))$/.test(model))
    throw new RangeError(
      `LambentSky: no model "${model}": fast, preetham, perez, asrc-cie, cie-clear, cie-overcast, ` +
        "cie:1 to cie:15",
    );
  for (const value of [directNormal, diffuseHorizontal]) {
    if (value === undefined) continue;
    if (!isMeasured(model))
      throw new RangeError(`LambentSky: irradiances are of perez and asrc-cie, not of ${model}`);
    if (!(value >= 0 && value <= 2000))
      throw new RangeError(`LambentSky: an irradiance of ${value} is not within 0 to 2000 W/m²`);
  }
}

/**
 * Makes skies: of a place and a moment, or of a height of the Sun; some milliseconds each, without
 * a server. Seen from the ground, which reflects 0.1 of the light; the preset "clear".
 */
export class LambentSky {
  private readonly data: SkyData;

  /**
   * @param data the bytes of three-lambent/data/sky.bin
   * @throws Error if they are something else
   */
  constructor(data: ArrayBuffer) {
    this.data = new SkyData(data);
  }

  /** Fetches the data. @throws Error if there is none at the address */
  static async load(url: string | URL): Promise<LambentSky> {
    const response = await fetch(url);
    if (!response.ok)
      throw new Error(`LambentSky: ${String(url)}: the server answers ${response.status}`);
    return new LambentSky(await response.arrayBuffer());
  }

  /** Where the Sun is seen; whether there is a sky does not matter. Radians. @throws RangeError */
  static sun(request: SkyRequest): { elevation: number; azimuth: number } {
    const { elevation, azimuth } = seenSun(request);
    return { elevation, azimuth };
  }

  private analytic(
    { model, turbidity = 2.5, directNormal, diffuseHorizontal }: SkyRequest,
    elevation: number,
    sunDistance: number,
  ): AnalyticSky & { directIlluminance?: number } {
    if (!isMeasured(model!)) return analyticSky(model as AnalyticModel, turbidity, elevation);
    const clear = clearSkyIrradiance(turbidity, elevation, sunDistance);
    const { luminous, directIlluminance } = measuredSky(
      model,
      this.data.measured,
      {
        directNormal: directNormal ?? clear.directNormal,
        diffuseHorizontal: diffuseHorizontal ?? clear.diffuseHorizontal,
      },
      elevation,
      sunDistance,
    );
    return { ...domeOf(luminous, elevation), shines: true, directIlluminance };
  }

  /**
   * @throws RangeError for what is out of its range; a Sun below −18° is night, which has no sky of
   *   the Sun's
   */
  at(request: SkyRequest): Sky {
    const { model = "fast", turbidity = 2.5 } = request;
    if (!(turbidity >= 1 && turbidity <= 10))
      throw new RangeError(`LambentSky: the turbidity ${turbidity} is not within 1 to 10`);
    checkModel(request);
    const seen = seenSun(request);
    if (seen.elevation < kNight - 1e-9)
      throw new RangeError(
        `LambentSky: the Sun stands at ${((seen.elevation * 180) / Math.PI).toFixed(2)}°: below ` +
          "-18° it is night, and there is no sky of the Sun's",
      );
    const elevation = Math.max(seen.elevation, kNight);
    const angularRadius = kSunRadius / seen.distance;
    const visible = discAbove(elevation / angularRadius);
    const nearness = 1 / seen.distance ** 2;

    const simulated = model === "fast" ? this.data.dome(turbidity, elevation) : null;
    const analytic = simulated ? null : this.analytic(request, elevation, seen.distance);
    const { grid, diffuse } = simulated ?? analytic!;
    let sun = [0, 0, 0];
    let direct = [0, 0, 0]; // on the ground
    if (simulated) {
      for (let i = 0; i < grid.length; ++i) grid[i] *= nearness;
      sun = this.data.sun(turbidity, elevation).map((value) => nearness * value);
      direct = sun.map((value) => value * horizontalShareOfDisc(elevation));
      sun = sun.map((value) => value * visible);
    } else if (analytic!.shines) {
      sun = this.data.plainSun(turbidity, elevation).map((value) => nearness * visible * value);
      const { directIlluminance } = analytic!;
      if (directIlluminance !== undefined) {
        const scale = sun[1] > 0 ? (visible * directIlluminance) / sun[1] : 0;
        sun = sun.map((value) => scale * value);
      }
      direct = sun.map((value) => value * Math.max(Math.sin(elevation), 0));
    }
    const dome = simulated ? nearness : 1;
    const ground = [0, 1, 2].map((i) => (kAlbedo / Math.PI) * (dome * diffuse[i] + direct[i]));

    const irradiance = shownRgb(sun[0], sun[1], sun[2]);
    const direction = worldDirection(seen.azimuth, elevation);
    const shape: Disc = {
      direction: { x: direction[0], y: direction[1], z: direction[2] },
      diameter: 2 * angularRadius,
      radiance: [1, 1, 1],
      limbDarkening,
      horizon: { up: kUp, elevation: 0 },
    };
    const perCenter = visible > 0 ? irradianceOfDisc(shape, direction) : [0, 0, 0];
    // So little of it above the horizon that its border alone would decide how bright it is: none.
    const least = 1e-7 * (Math.PI / 2) * angularRadius ** 2;
    const shown = irradiance.some((value) => value > 0) && Math.min(...perCenter) > least;
    const radiance = irradiance.map((value, c) => value / perCenter[c]) as [number, number, number];
    return new Sky(
      domeTexture(grid),
      projectDome(grid, seen.azimuth),
      shownRgb(ground[0], ground[1], ground[2]),
      {
        elevation,
        azimuth: seen.azimuth,
        direction,
        irradiance,
        angularRadius,
        nearness,
        visible,
        disc: shown ? { ...shape, radiance } : null,
      },
      turbidity,
    );
  }
}

