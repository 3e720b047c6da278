// Skies known by two irradiances that weather stations measure: perez1993all with perez1990modeling, and
// ASRC-CIE. As lambent/sky/perez.cpp, asrc_cie.cpp and analytic_sky.cpp, whose legends and deviations
// hold here; the tables are theirs, out of data/sky.bin.
//
// This work is based on: rigollier2000clear (irradiance of clear skies), kasten1989revised,
// kasten1996linke (air), nakamura1985luminance (the intermediate sky).

import {
  airMass,
  clamp,
  forDome,
  shapeAt,
  white,
  type Luminous,
  type Shape,
} from "./analytic_forms.js";
import { twilightFactor } from "./twilight.js";

/** Row after row: of lambent/sky/perez_tables.h and AsrcKnots. */
export interface MeasuredTables {
  borders: number[];
  pattern: number[];
  diffuse: number[];
  direct: number[];
  knots: [number, number, number, number, number];
}

export type MeasuredModel = "perez" | "asrc-cie";

/** W m⁻²: of the Sun on a surface that faces it, of the sky on a horizontal one. */
export interface Irradiances {
  directNormal: number;
  diffuseHorizontal: number;
}

export interface MeasuredSky {
  luminous: Luminous;
  /** Of the Sun on a surface that faces it, lx. */
  directIlluminance: number;
}

const kSolarConstant = 1367; // W m⁻²
const kBlend = 0.03; // about a border, as a logarithm
const kWater = 2; // cm, precipitable

/** What a station would measure under a clear sky of a turbidity. `sunElevation` in radians. */
export function clearSkyIrradiance(
  turbidity: number,
  sunElevation: number,
  sunDistance: number,
): Irradiances {
  const above = kSolarConstant / sunDistance ** 2;
  const t = clamp(turbidity, 1, 12);
  const height = clamp(sunElevation, 0, Math.PI / 2);
  const s = Math.sin(height);
  const m = 1 / (s + 0.50572 * ((height * 180) / Math.PI + 6.07995) ** -1.6364);
  const inverseThickness =
    m > 20
      ? 10.4 + 0.718 * m
      : 6.6296 + m * (1.7513 + m * (-0.1202 + m * (0.0065 - m * 0.00013)));
  const trd = -1.5843e-2 + 3.0543e-2 * t + 3.797e-4 * t * t;
  const a0 = Math.max(0.26463 - 0.061581 * t + 0.0031408 * t * t, 2e-3 / trd);
  const a1 = 2.0402 + 0.018945 * t - 0.011161 * t * t;
  const a2 = -1.3025 + 0.039231 * t + 0.0085079 * t * t;
  const twilight = twilightFactor(sunElevation);
  return {
    directNormal: above * Math.exp((-0.8662 * t * m) / inverseThickness) * twilight,
    diffuseHorizontal: above * trd * Math.max(a0 + s * (a1 + s * a2), 0) * twilight,
  };
}

interface Condition {
  clearness: number;
  brightness: number;
}

function conditionOf(irradiances: Irradiances, sun: number, sunDistance: number): Condition {
  const diffuse = Math.max(irradiances.diffuseHorizontal, 0);
  const direct = Math.max(irradiances.directNormal, 0);
  const cubic = 1.041 * (Math.PI / 2 - sun) ** 3;
  const ratio = diffuse > 0 ? direct / diffuse : direct > 0 ? 1e3 : 0;
  const above = kSolarConstant / sunDistance ** 2;
  return {
    clearness: clamp((1 + ratio + cubic) / (1 + cubic), 1, 12),
    brightness: clamp((airMass(sun) * diffuse) / above, 0.01, 0.6),
  };
}

/** Rows of a clearness with their shares: two beside a border. */
function rowsOf({ borders }: MeasuredTables, clearness: number): [number, number][] {
  for (let border = 0; border < borders.length; ++border) {
    const distance = Math.log(clearness / borders[border]);
    if (Math.abs(distance) >= kBlend) continue;
    const t = (distance / kBlend + 1) / 2;
    const upper = t * t * (3 - 2 * t);
    return [
      [border, 1 - upper],
      [border + 1, upper],
    ];
  }
  return [[borders.filter((each) => each <= clearness).length, 1]];
}

function shapeOf({ pattern }: MeasuredTables, row: number, brightness: number, zenith: number): Shape {
  const of = (i: number) => pattern.slice(4 * (5 * row + i), 4 * (5 * row + i) + 4);
  const delta = row >= 1 && row <= 4 ? Math.max(brightness, 0.2) : brightness;
  const [a, b, c, d, e] = [0, 1, 2, 3, 4].map((i) => {
    const x = of(i);
    return x[0] + x[1] * zenith + delta * (x[2] + x[3] * zenith);
  });
  const shape = { a, b: Math.min(b, 0), c, d, e, k: 1 };
  if (row === 0) {
    const [x, y] = [of(2), of(3)];
    shape.c = Math.exp((delta * (x[0] + x[1] * zenith)) ** x[2]) - x[3];
    shape.d = -Math.exp(delta * (y[0] + y[1] * zenith)) + y[2] + delta * y[3];
  }
  return shape;
}

/** lm/W of diffuse and direct irradiance. */
function efficacyOf(tables: MeasuredTables, row: number, brightness: number, zenith: number) {
  const f = tables.diffuse.slice(4 * row, 4 * row + 4);
  const n = tables.direct.slice(4 * row, 4 * row + 4);
  return {
    diffuse: Math.max(
      f[0] + f[1] * kWater + f[2] * Math.cos(zenith) + f[3] * Math.log(brightness),
      0,
    ),
    direct: Math.max(
      n[0] + n[1] * kWater + n[2] * Math.exp(5.73 * zenith - 5) + n[3] * brightness,
      0,
    ),
  };
}

type Relative = (cosZenith: number, sunAngle: number) => number;

/** ∫ luminance cos θ ds over the dome. */
function onHorizontalPlane(luminance: Relative, sun: number): number {
  let sum = 0;
  forDome(32, sun, (cosZenith, angle, weight) => {
    sum += weight * luminance(cosZenith, angle);
  });
  return sum;
}

interface Levels extends Condition {
  luminance: Relative;
  /** lx. */
  diffuse: number;
  direct: number;
}

function perez(
  tables: MeasuredTables,
  measured: Irradiances,
  sun: number,
  sunDistance: number,
): Levels {
  const zenith = Math.PI / 2 - sun;
  const condition = conditionOf(measured, sun, sunDistance);
  const parts: { shape: Shape; scale: number }[] = [];
  let [diffuse, direct] = [0, 0];
  for (const [row, share] of rowsOf(tables, condition.clearness)) {
    if (!(share > 0)) continue;
    let shape = shapeOf(tables, row, condition.brightness, zenith);
    const efficacy = efficacyOf(tables, row, condition.brightness, zenith);
    const illuminance = share * efficacy.diffuse * Math.max(measured.diffuseHorizontal, 0);
    diffuse += illuminance;
    direct += share * efficacy.direct * Math.max(measured.directNormal, 0);
    let integral = onHorizontalPlane((y, angle) => shapeAt(shape, y, angle), sun);
    if (!(integral > 1e-9)) {
      // Nothing is left of the pattern: an even sky.
      shape = { a: 0, b: -1, c: 0, d: -1, e: 0, k: 1 };
      integral = Math.PI;
    }
    parts.push({ shape, scale: illuminance / integral });
  }
  const luminance: Relative = (cosZenith, angle) =>
    parts.reduce(
      (sum, { shape, scale }) => sum + (scale > 0 ? scale * shapeAt(shape, cosZenith, angle) : 0),
      0,
    );
  return { ...condition, luminance, diffuse, direct };
}

/** The intermediate sky, up to a factor. */
function intermediate(sun: number): Relative {
  return (cosZenith, angle) => {
    const height = Math.asin(clamp(cosZenith, 0, 1));
    const level =
      (1.35 * (Math.sin(3.59 * height - 0.009) + 2.31) * Math.sin(2.6 * sun + 0.316) +
        height +
        4.799) /
      2.326;
    const fall = 0.563 * angle * ((sun - 0.008) * (height + 1.059) + 0.812);
    return Math.max(level, 0) * Math.exp(-fall);
  };
}

const cloudless =
  (c: number, e: number, k: number): Relative =>
  (cosZenith, angle) =>
    shapeAt({ a: -1, b: -0.32, c, d: -3, e, k }, cosZenith, angle);

function asrcCie({ knots }: MeasuredTables, levels: Levels, sun: number): Relative {
  const ramp = (x: number, from: number, to: number) => clamp((x - from) / (to - from), 0, 1);
  const [overcastUntil, intermediateAt, cloudlessFrom, clearUntil, turbidFrom] = knots;
  const opening = ramp(levels.clearness, overcastUntil, intermediateAt);
  const open = ramp(levels.clearness, intermediateAt, cloudlessFrom);
  const turbid = ramp(levels.brightness, clearUntil, turbidFrom);
  const skies: [number, Relative][] = [
    [open * (1 - turbid), cloudless(10, 0.45, 0.91)],
    [open * turbid, cloudless(16, 0.3, 0.856)],
    [opening * (1 - open), intermediate(sun)],
    [(1 - opening) * (1 - open), (cosZenith) => (1 + 2 * clamp(cosZenith, 0, 1)) / 3],
  ];
  const scaled = skies
    .filter(([weight]) => weight > 0)
    .map(([weight, sky]): [number, Relative] => [
      (weight * levels.diffuse) / onHorizontalPlane(sky, sun),
      sky,
    ]);
  return (cosZenith, angle) =>
    scaled.reduce((sum, [scale, sky]) => sum + scale * sky(cosZenith, angle), 0);
}

/** @param sunElevation radians; below the horizon it counts as on it */
export function measuredSky(
  model: MeasuredModel,
  tables: MeasuredTables,
  measured: Irradiances,
  sunElevation: number,
  sunDistance: number,
): MeasuredSky {
  const sun = clamp(sunElevation, 0, Math.PI / 2);
  const levels = perez(tables, measured, sun, sunDistance);
  const luminance = model === "perez" ? levels.luminance : asrcCie(tables, levels, sun);
  return {
    luminous: (cosZenith, angle) => white(luminance(cosZenith, angle)),
    directIlluminance: levels.direct,
  };
}

