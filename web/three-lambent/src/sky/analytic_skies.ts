// Skies in closed form: CIE's overcast and clear sky and the fifteen of the standard general sky,
// and preetham1999practical. As lambent/sky/standard_skies.cpp and preetham.cpp, whose deviations
// from the papers hold here.
//
// This work is based on: CIE S 011 / ISO 15469:2004 and darula2002cie (the fifteen),
// preetham2003modeling (CIE's clear sky of 1973), moon1942illumination (overcast),
// krochmann1974quantitative and karayel1984zenith (zenith luminances), kasten1965new (air mass).

import {
  airMass,
  angleFromSun,
  clamp,
  forDome,
  shapeAt,
  white,
  type Luminous,
  type Shape,
  type Triple,
} from "./analytic_forms.js";
import { rgbOfXyz } from "./color.js";
import { domeAzimuth, domeElevation, kDomeColumns, kDomeRows, type DomeGrid } from "./grids.js";
import { twilightFactor } from "./twilight.js";

export type AnalyticModel = "preetham" | "cie-clear" | "cie-overcast" | `cie:${number}`;

export interface AnalyticSky {
  grid: DomeGrid;
  /** X, Y, Z in lx on the ground. */
  diffuse: Triple;
  /** Whether the Sun shines through. */
  shines: boolean;
}

// The fifteen: gradation 1 … 6, indicatrix 1 … 6, diffuse over extraterrestrial illuminance.
const kGradations = [
  [4, -0.7],
  [1.1, -0.8],
  [0, -1],
  [-1, -0.55],
  [-1, -0.32],
  [-1, -0.15],
];
const kIndicatrices = [
  [0, -1, 0],
  [2, -1.5, 0.15],
  [5, -2.5, 0.3],
  [10, -3, 0.45],
  [16, -3, 0.3],
  [24, -2.8, 0.15],
];
const kTypes = [
  [1, 1, 0.1],
  [1, 2, 0.18],
  [2, 1, 0.15],
  [2, 2, 0.22],
  [3, 1, 0.2],
  [3, 2, 0.38],
  [3, 3, 0.42],
  [3, 4, 0.41],
  [4, 2, 0.4],
  [4, 3, 0.36],
  [4, 4, 0.23],
  [5, 4, 0.1],
  [5, 5, 0.28],
  [6, 5, 0.28],
  [6, 6, 0.3],
];
const kSolarIlluminance = 133.8e3; // lx, above the air

function graded(shape: Shape, sun: number, zenithLuminance: number): Luminous {
  const scale = zenithLuminance / shapeAt(shape, 1, Math.PI / 2 - sun);
  return (cosZenith, angle) => white(scale * shapeAt(shape, cosZenith, angle));
}

function standardSky(type: number, sun: number): Luminous {
  const [g, i, ratio] = kTypes[type - 1];
  const [a, b] = kGradations[g - 1];
  const [c, d, e] = kIndicatrices[i - 1];
  const shape = { a, b, c, d, e, k: 1 - c * Math.exp((d * Math.PI) / 2) };
  let relative = 0;
  forDome(32, sun, (cosZenith, angle, weight) => {
    relative += weight * shapeAt(shape, cosZenith, angle);
  });
  const scale = (ratio * kSolarIlluminance) / airMass(sun) / relative;
  return (cosZenith, angle) => white(scale * shapeAt(shape, cosZenith, angle));
}

function clearSky(turbidity: number, sun: number): Luminous {
  const bend = (75 * Math.PI) / 180;
  const tangent = Math.tan(Math.min(sun, bend));
  const bounded = tangent + (1 + tangent * tangent) * Math.max(sun - bend, 0);
  const linke = clamp(turbidity, 1.4, 12);
  const shape = { a: -1, b: -0.32, c: 10, d: -3, e: 0.45, k: 0.91 };
  return graded(shape, sun, 1000 * ((1.376 * linke - 1.81) * bounded + 0.38));
}

// The five coefficients of Preetham's forms, each k₁ T + k₀.
const kLuminance = [
  [0.1787, -1.463],
  [-0.3554, 0.4275],
  [-0.0227, 5.3251],
  [0.1206, -2.5771],
  [-0.067, 0.3703],
];
const kChromaticityX = [
  [-0.0193, -0.2592],
  [-0.0665, 0.0008],
  [-0.0004, 0.2125],
  [-0.0641, -0.8989],
  [-0.0033, 0.0452],
];
const kChromaticityY = [
  [-0.0167, -0.2608],
  [-0.095, 0.0092],
  [-0.0079, 0.2102],
  [-0.0441, -1.6537],
  [-0.0109, 0.0529],
];
// Rows T², T, 1; columns θ³, θ², θ, 1 of the Sun's zenith angle.
const kZenithX = [
  [0.00166, -0.00375, 0.00209, 0],
  [-0.02903, 0.06377, -0.03202, 0.00394],
  [0.11693, -0.21196, 0.06052, 0.25886],
];
const kZenithY = [
  [0.00275, -0.0061, 0.00317, 0],
  [-0.04214, 0.0897, -0.04153, 0.00516],
  [0.15346, -0.26756, 0.0667, 0.26688],
];

function preetham(turbidity: number, sun: number): Luminous {
  const t = clamp(turbidity, 2, 10);
  const s = Math.PI / 2 - sun;
  const polynomial = (m: number[][]) => {
    const row = (i: number) => m[i][3] + s * (m[i][2] + s * (m[i][1] + s * m[i][0]));
    return row(2) + t * (row(1) + t * row(0));
  };
  const part = (table: number[][], zenithValue: number) => {
    const [a, b, c, d, e] = table.map(([k1, k0]) => k1 * t + k0);
    const shape = { a, b, c, d, e, k: 1 };
    const scale = zenithValue / shapeAt(shape, 1, s);
    return (cosZenith: number, angle: number) => scale * shapeAt(shape, cosZenith, angle);
  };
  const chi = (4 / 9 - t / 120) * (Math.PI - 2 * s);
  const zenith = Math.max((4.0453 * t - 4.971) * Math.tan(chi) - 0.2155 * t + 2.4192, 0);
  const luminance = part(kLuminance, 1000 * zenith);
  const x = part(kChromaticityX, polynomial(kZenithX));
  const y = part(kChromaticityY, polynomial(kZenithY));
  return (cosZenith, angle) => {
    const cx = x(cosZenith, angle);
    const cy = y(cosZenith, angle);
    const scale = luminance(cosZenith, angle) / Math.max(cy, 1e-6);
    return [scale * cx, scale * cy, scale * (1 - cx - cy)];
  };
}

function skyOf(model: AnalyticModel, turbidity: number, sun: number): Luminous {
  if (model === "preetham") return preetham(turbidity, sun);
  if (model === "cie-clear") return clearSky(turbidity, sun);
  if (model === "cie-overcast") {
    const zenith = 123 + 8600 * Math.sin(sun);
    return (cosZenith) => white((zenith * (1 + 2 * clamp(cosZenith, 0, 1))) / 3);
  }
  return standardSky(Number(model.slice(4)), sun);
}

/**
 * @param turbidity 1 … 10, where a model has one
 * @param sunElevation radians; below the horizon the sky of sunset, darker
 */
export function analyticSky(
  model: AnalyticModel,
  turbidity: number,
  sunElevation: number,
): AnalyticSky {
  const sky = skyOf(model, turbidity, clamp(sunElevation, 0, Math.PI / 2));
  const type = model.startsWith("cie:") ? Number(model.slice(4)) : 0;
  const shines = type ? type > 6 && type !== 9 : model !== "cie-overcast";
  return { ...domeOf(sky, sunElevation, twilightFactor(sunElevation)), shines };
}

/** The grid of a model's dome, every luminance times a factor. */
export function domeOf(
  sky: Luminous,
  sunElevation: number,
  factor = 1,
): { grid: DomeGrid; diffuse: Triple } {
  const sun = clamp(sunElevation, 0, Math.PI / 2);
  const grid = new Float32Array(3 * kDomeRows * kDomeColumns);
  const rgb = [0, 0, 0];
  for (let r = 0; r < kDomeRows; ++r) {
    const elevation = domeElevation(r);
    const [sine, cosine] = [Math.sin(elevation), Math.cos(elevation)];
    for (let c = 0; c < kDomeColumns; ++c) {
      const azimuth = domeAzimuth(c);
      const [x, z] = [cosine * Math.cos(azimuth), cosine * Math.sin(azimuth)];
      const xyz = sky(sine, angleFromSun(x, sine, z, sun));
      rgbOfXyz(factor * xyz[0], factor * xyz[1], factor * xyz[2], rgb);
      grid.set(rgb, 3 * (r * kDomeColumns + c));
    }
  }
  const diffuse: Triple = [0, 0, 0];
  forDome(16, sun, (cosZenith, angle, weight) => {
    const xyz = sky(cosZenith, angle);
    for (let i = 0; i < 3; ++i) diffuse[i] += factor * weight * xyz[i];
  });
  return { grid, diffuse };
}
