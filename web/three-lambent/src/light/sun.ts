// The part of a light that is too small for harmonics: a disc, as the Sun's, whose shadows are sharp.
// As lambent/light/sun.cpp, whose legend holds here.

import { LambentLight, type Disc, type Rgb } from "./light.js";
import { worldFromTangent, type Vector } from "./frames.js";

/** Discs up to this angular diameter, radians, can be a light's Sun: 5°. */
export const kLargestSun = (5 * Math.PI) / 180;

/** One direction of a Sun, and the irradiance that it stands for on a surface that faces it. */
export interface SunPoint {
  /** Unit. */
  direction: Vector;
  irradiance: Rgb;
}

/** ∫ radiance ds over what is seen of a disc, W m⁻². */
function irradianceOf(disc: Disc): [number, number, number] {
  const [r, g, b] = new LambentLight(1).addDisc(disc).coefficients;
  const scale = Math.sqrt(4 * Math.PI);
  return [scale * r, scale * g, scale * b];
}

const luminance = (rgb: Rgb) => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];

/**
 * Of the discs of a light the one that is its Sun: at most {@link kLargestSun} across, the one that
 * brings most light, if there is one of which something stands above its horizon.
 */
export function sunOf(discs: readonly Disc[]): Disc | null {
  let [found, most]: [Disc | null, number] = [null, 0];
  for (const disc of discs) {
    if (disc.diameter > kLargestSun * (1 + 1e-6)) continue;
    const light = luminance(irradianceOf(disc));
    if (light > most) [found, most] = [disc, light];
  }
  return found;
}

interface Spot {
  direction: Vector;
  mu: number;
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function unit(v: Vector): Vector {
  const length = Math.hypot(...v);
  return [v[0] / length, v[1] / length, v[2] / length];
}

const combined = (a: number, u: Vector, b: number, v: Vector): Vector => [
  a * u[0] + b * v[0],
  a * u[1] + b * v[1],
  a * u[2] + b * v[2],
];

function greatestDivisor(a: number, b: number): number {
  return b === 0 ? a : greatestDivisor(b, a % b);
}

/** The step of a walk over 0 … count − 1 that visits each once: close to the golden section of it. */
function leapOf(count: number): number {
  let leap = Math.max(1, Math.round(0.618034 * count));
  while (greatestDivisor(leap, count) !== 1) ++leap;
  return leap;
}

/** Those of `count` places of the disc that stand above its horizon. */
function spotsAbove(axis: Vector, disc: Disc, count: number): Spot[] {
  const kGoldenTurns = 0.3819660112501051;
  const versine = 2 * Math.sin(disc.diameter / 4) ** 2;
  const [x, y] = worldFromTangent(axis);
  const up = disc.horizon && unit([disc.horizon.up.x, disc.horizon.up.y, disc.horizon.up.z]);
  const least = disc.horizon ? Math.sin(disc.horizon.elevation) : 0;
  const spots: Spot[] = [];
  const leap = leapOf(count);
  for (let i = 0, j = 0; i < count; ++i, j = (j + leap) % count) {
    const t = (j + 0.5) / count;
    const turn = 2 * Math.PI * ((j * kGoldenTurns) % 1);
    const height = t * versine;
    const sine = Math.sqrt(Math.max(0, height * (2 - height)));
    const aside = combined(Math.cos(turn), x, Math.sin(turn), y);
    const direction = combined(1 - height, axis, sine, aside);
    if (!up || dot(direction, up) >= least) spots.push({ direction, mu: Math.sqrt(1 - t) });
  }
  return spots;
}

/** The uppermost place of a disc of which no other was found above its horizon. */
function rim(axis: Vector, disc: Disc): Spot {
  const up: Vector = [disc.horizon!.up.x, disc.horizon!.up.y, disc.horizon!.up.z];
  const half = disc.diameter / 2;
  const level = unit(combined(1, up, -dot(up, axis), axis));
  return { direction: combined(Math.cos(half), axis, Math.sin(half), level), mu: 0 };
}

/**
 * `count` ≥ 1 points spread evenly over what is seen of a disc of at most {@link kLargestSun}, a part
 * of them too. The mean of their irradiance is the disc's in every channel. A single one stands in
 * the middle.
 */
export function sunPoints(disc: Disc, count: number): SunPoint[] {
  const kMostTries = 4096; // of a sliver above the horizon
  const axis = unit([disc.direction.x, disc.direction.y, disc.direction.z]);
  let spots: Spot[] = [];
  if (count === 1) {
    const kEnough = 256;
    const seen = spotsAbove(axis, disc, kEnough);
    const middle = seen.reduce<Vector>((sum, spot) => combined(1, sum, 1, spot.direction), [0, 0, 0]);
    if (seen.length === kEnough) spots = [{ direction: axis, mu: 1 }];
    else if (seen.length > 0) spots = [{ direction: unit(middle), mu: 1 }];
  }
  for (let tries = count; spots.length < count && tries <= kMostTries; tries *= 2)
    spots = spotsAbove(axis, disc, tries);
  if (spots.length === 0) spots = [rim(axis, disc)];
  const irradiance = irradianceOf(disc);
  const dark = disc.limbDarkening ?? [0, 0, 0];
  const points = Array.from({ length: count }, (_, i) => spots[i % spots.length]);
  const shares = points.map(({ mu }) => dark.map((u) => 1 - u * (1 - mu)));
  const sums = [0, 1, 2].map((c) => shares.reduce((sum, share) => sum + share[c], 0));
  return points.map(({ direction }, i) => ({
    direction,
    irradiance: irradiance.map((value, c) =>
      sums[c] > 0 ? (shares[i][c] * value * count) / sums[c] : 0,
    ) as [number, number, number],
  }));
}
