// How a band of a function on the sphere is told by its values in 2l + 1 directions: what
// src/glsl/turn.frag.glsl rotates light with.
//
// Directions are spread over a hemisphere (a band is even or odd: the other half repeats it). The
// matrix that solves for the coefficients is the inverse of Y_km = y_lm(d_k), by elimination with
// pivots; its condition is below 20 for all bands, which a test looks at.

import { evaluateHarmonics } from "../sh/basis.js";

/** 2·bands − 1 unit directions, of which band l uses the first 2l + 1. */
export interface TurnSamples {
  /** x, y, z each. */
  directions: Float32Array;
  /** [coefficient][k], `width` numbers a row: the share of value k in the coefficient. */
  solve: Float32Array;
  width: number;
}

function inverse(matrix: Float64Array, n: number): Float64Array {
  const a = matrix.slice();
  const out = new Float64Array(n * n);
  for (let i = 0; i < n; ++i) out[i * n + i] = 1;
  for (let column = 0; column < n; ++column) {
    let pivot = column;
    for (let r = column + 1; r < n; ++r)
      if (Math.abs(a[r * n + column]) > Math.abs(a[pivot * n + column])) pivot = r;
    for (let c = 0; c < n; ++c) {
      [a[column * n + c], a[pivot * n + c]] = [a[pivot * n + c], a[column * n + c]];
      [out[column * n + c], out[pivot * n + c]] = [out[pivot * n + c], out[column * n + c]];
    }
    const scale = 1 / a[column * n + column];
    for (let c = 0; c < n; ++c) {
      a[column * n + c] *= scale;
      out[column * n + c] *= scale;
    }
    for (let r = 0; r < n; ++r) {
      const factor = a[r * n + column];
      if (r === column || factor === 0) continue;
      for (let c = 0; c < n; ++c) {
        a[r * n + c] -= factor * a[column * n + c];
        out[r * n + c] -= factor * out[column * n + c];
      }
    }
  }
  return out;
}

/** Directions of which every beginning of odd length is well spread over the hemisphere. */
function spreadDirections(count: number): number[][] {
  // Each next one is that of many candidates which is farthest from those before and from what
  // lies opposite to them.
  const turn = Math.PI * (3 - Math.sqrt(5));
  const candidates = Array.from({ length: 2000 }, (_, i) => {
    const z = (i + 0.5) / 2000;
    const r = Math.sqrt(1 - z * z);
    return [r * Math.cos(turn * i), r * Math.sin(turn * i), z];
  });
  const chosen = [candidates[candidates.length - 1]];
  while (chosen.length < count) {
    let best = candidates[0];
    let least = Infinity;
    for (const c of candidates) {
      const near = Math.max(...chosen.map((d) => Math.abs(c[0] * d[0] + c[1] * d[1] + c[2] * d[2])));
      if (near < least) {
        least = near;
        best = c;
      }
    }
    chosen.push(best);
  }
  return chosen;
}

/** @param bands 1 … 10 */
export function turnSamples(bands: number): TurnSamples {
  const width = 2 * bands - 1;
  const directions = spreadDirections(width);
  const solve = new Float32Array(bands * bands * width);
  const y = new Float64Array(bands * bands);
  for (let l = 0; l < bands; ++l) {
    const n = 2 * l + 1;
    const values = new Float64Array(n * n);
    for (let k = 0; k < n; ++k) {
      const [x, yy, z] = directions[k];
      evaluateHarmonics(bands, x, yy, z, y);
      for (let m = 0; m < n; ++m) values[k * n + m] = y[l * l + m];
    }
    const back = inverse(values, n);
    for (let m = 0; m < n; ++m)
      for (let k = 0; k < n; ++k) solve[(l * l + m) * width + k] = back[m * n + k];
  }
  return { directions: Float32Array.from(directions.flat()), solve, width };
}
