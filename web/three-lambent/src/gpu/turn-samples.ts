// How a band of a function on the sphere is told by its values in 2l + 1 directions: what
// src/glsl/turn.frag.glsl rotates light with.
//
// The directions of a band are chosen one after the other out of many, each where the band's
// functions, less what the directions before it tell, are largest (a factorisation with pivots). The
// shares are the inverse of Y_km = y_lm(d_k); errors of the values grow less than tenfold, which a
// test looks at.

import { evaluateHarmonics } from "../sh/basis.js";

/** Texels of (x, y, z, share): column k of row i is sample k of coefficient i. */
export interface TurnSamples {
  texels: Float32Array;
  /** Texels of a row: 2·bands − 1. */
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

/** 2l + 1 unit directions. */
function samplesOf(l: number): number[][] {
  const n = 2 * l + 1;
  const count = 40 * n;
  const turn = Math.PI * (3 - Math.sqrt(5));
  const y = new Float64Array((l + 1) ** 2);
  // Over a hemisphere: a band is even or odd, and the other half repeats it.
  const candidates = Array.from({ length: count }, (_, i) => {
    const z = (i + 0.5) / count;
    const r = Math.sqrt(1 - z * z);
    const d = [r * Math.cos(turn * i), r * Math.sin(turn * i), z];
    evaluateHarmonics(l + 1, d[0], d[1], d[2], y);
    return { d, rest: Float64Array.from(y.subarray(l * l)) };
  });
  const square = (v: Float64Array) => v.reduce((sum, x) => sum + x * x, 0);
  const chosen: number[][] = [];
  while (chosen.length < n) {
    const best = candidates.reduce((a, b) => (square(b.rest) > square(a.rest) ? b : a));
    chosen.push(best.d);
    const size = Math.sqrt(square(best.rest));
    const axis = best.rest.map((x) => x / size);
    for (const { rest } of candidates) {
      const along = rest.reduce((sum, x, m) => sum + x * axis[m], 0);
      for (let m = 0; m < n; ++m) rest[m] -= along * axis[m];
    }
  }
  return chosen;
}

/** @param bands 1 … 10 */
export function turnSamples(bands: number): TurnSamples {
  const width = 2 * bands - 1;
  const texels = new Float32Array(4 * bands * bands * width);
  const y = new Float64Array(bands * bands);
  for (let l = 0; l < bands; ++l) {
    const n = 2 * l + 1;
    const directions = samplesOf(l);
    const values = new Float64Array(n * n);
    directions.forEach((d, k) => {
      evaluateHarmonics(bands, d[0], d[1], d[2], y);
      values.set(y.subarray(l * l, (l + 1) ** 2), k * n);
    });
    const shares = inverse(values, n);
    for (let m = 0; m < n; ++m)
      for (let k = 0; k < n; ++k)
        texels.set([...directions[k], shares[m * n + k]], 4 * ((l * l + m) * width + k));
  }
  return { texels, width };
}
