// Functions that are symmetric about an axis, kept as Legendre moments ĥ_l = 2π ∫ h(t) P_l(t) dt,
// by which convolution multiplies: (h * f)_lm = ĥ_l f_lm. As lambent/sh/zonal.h.
//
// This work is based on:
// - ramamoorthi2001efficient: eq. 8-9, the clamped cosine in closed form.
// - sloan2002precomputed: eq. 6 and Appendix: convolution and turning of symmetric functions.

import { evaluateHarmonics } from "./basis.js";
import { gaussLegendre } from "./quadrature.js";

/** max(cos θ, 0): π, 2π/3, π/4, 0, −π/24, … */
export function clampedCosineMoments(bands: number): Float64Array {
  const moments = new Float64Array(bands);
  let central = 1; // l! / (2^l (l/2)!²)
  for (let l = 0; l < bands; l += 2) {
    if (l > 0) central *= (l - 1) / l;
    const sign = (l / 2) % 2 ? 1 : -1;
    moments[l] = (2 * Math.PI * sign * central) / ((l + 2) * (l - 1));
  }
  if (bands > 1) moments[1] = (2 * Math.PI) / 3;
  return moments;
}

/** 1 within halfAngle (radians, 0 … π) of the axis. The form used does not cancel for small ones. */
export function capMoments(bands: number, halfAngle: number): Float64Array {
  const moments = new Float64Array(bands);
  const half = Math.sin(halfAngle / 2);
  const sine = Math.sin(halfAngle);
  const c = Math.cos(halfAngle);
  moments[0] = 4 * Math.PI * half * half;
  let previous = 1;
  let p = c; // P_{l−1}, P_l
  let slopePrevious = 0;
  let slope = 1; // their derivatives
  for (let l = 1; l < bands; ++l) {
    // ∫_c¹ P_l dt = (1 − c²) P_l'(c) / (l(l+1))
    moments[l] = (2 * Math.PI * sine * sine * slope) / (l * (l + 1));
    const next = ((2 * l + 1) * c * p - l * previous) / (l + 1);
    const slopeNext = slopePrevious + (2 * l + 1) * p;
    previous = p;
    p = next;
    slopePrevious = slope;
    slope = slopeNext;
  }
  return moments;
}

/** (r+1)/2π · max(0, cos θ)^r, of unit integral. */
export function phongLobeMoments(bands: number, exponent: number): Float64Array {
  const moments = new Float64Array(bands);
  for (let l = 0; l < bands; ++l) {
    if (l === 0) moments[l] = 1;
    else if (l === 1) moments[l] = (exponent + 1) / (exponent + 2);
    else moments[l] = (moments[l - 2] * (exponent - l + 2)) / (exponent + l + 1);
  }
  return moments;
}

/** P_0 … P_{count−1} at t. */
export function legendre(count: number, t: number): Float64Array {
  const p = new Float64Array(count);
  for (let l = 0; l < count; ++l)
    p[l] = l === 0 ? 1 : l === 1 ? t : ((2 * l - 1) * t * p[l - 1] - (l - 1) * p[l - 2]) / l;
  return p;
}

/**
 * The sharpest function of n bands, n ≥ 1, that is nowhere negative: unit integral, largest ĥ_1.
 * What is convolved with it, and was not negative, does not ring. As lambent/sh/zonal.cpp, which
 * derives it.
 */
export function sharpestNonNegative(bands: number): Float64Array {
  const m = Math.floor((bands - 1) / 2);
  const even = bands % 2 === 0;
  const nodal = (t: number) => {
    const p = legendre(m + 3, t);
    return even ? (p[m + 1] + p[m + 2]) / (1 + t) : p[m + 1];
  };
  let high = 1;
  let low = 1;
  while (nodal(low) > 0 && low > -0.9) low -= 0.25 / bands ** 2;
  for (let i = 0; i < 60; ++i) {
    const middle = (low + high) / 2;
    if (nodal(middle) > 0) high = middle;
    else low = middle;
  }
  const largest = (low + high) / 2;
  const rule = gaussLegendre(bands + 1, -1, 1); // no node is a root of what it is divided by
  const moments = new Float64Array(bands);
  rule.nodes.forEach((t, i) => {
    const root = nodal(t) / (t - largest);
    const h = rule.weights[i] * (even ? 1 + t : 1) * root * root;
    legendre(bands, t).forEach((p, l) => (moments[l] += h * p));
  });
  return moments.map((each) => each / moments[0]);
}

/** Coefficients of a zonal function turned to a unit axis: f_lm = ĥ_l y_lm(axis). */
export function turnZonal(moments: Float64Array, x: number, y: number, z: number): Float64Array {
  const bands = moments.length;
  const out = evaluateHarmonics(bands, x, y, z) as Float64Array;
  for (let l = 0; l < bands; ++l)
    for (let i = l * l; i < (l + 1) * (l + 1); ++i) out[i] *= moments[l];
  return out;
}
