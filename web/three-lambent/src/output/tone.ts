// From scene-referred linear RGB to what a screen shows: lambent/tone/tone_curve.h in TypeScript,
// and shaders/tone.glsl, to 1/255.
//
// f(x) = (x + a x²) / (1 + a x + a x²), a = 2, of the family that reinhard2002photographic eq. 3
// opens.

import { tone } from "../generated/tone.js";

export type ToneCurve = "filmic" | "linear";

/** 0.18 → 0.172, 1 → 0.6, 16 → 0.969. Negative values and NaN become 0. */
export function filmic(linear: number): number {
  const x = linear > 0 ? Math.min(linear, 65504) : 0;
  return (x * (1 + 2 * x)) / (1 + 2 * x * (1 + x));
}

/** IEC 61966-2-1. */
export function srgbEncode(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

/** IEC 61966-2-1. */
export function srgbDecode(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

/**
 * `vec3 filmic(vec3)`, `vec3 cutToOne(vec3)` (the linear curve) and `vec3 srgbEncode(vec3)`, for
 * shaders of one's own.
 */
export const toneGlsl: string = tone;
