// This work is based on:
// - ivanic1996rotation: eq. 8.1 and Tables 1-2, with the correction of 1998 (Table 2, V for m < 0).
//
// The matrix of a band from that of the band below: R^l = u U + v V + w W, where r is the 3×3 matrix
// over (y, z, x), which is band 1. As lambent/sh/rotation_tables.h.

import { kMaxBands } from "./basis.js";

function bandFromBelow(l: number, r: Float64Array, below: Float64Array, out: Float64Array): void {
  const width = 2 * l + 1;
  const b = (m: number, n: number) => below[(m + l - 1) * (width - 2) + (n + l - 1)];
  const p = (i: number, m: number, n: number) => {
    const row = (i + 1) * 3;
    if (n === l) return r[row + 2] * b(m, l - 1) - r[row] * b(m, -l + 1);
    if (n === -l) return r[row + 2] * b(m, -l + 1) + r[row] * b(m, l - 1);
    return r[row + 1] * b(m, n);
  };
  for (let m = -l; m <= l; ++m) {
    const a = Math.abs(m);
    const un = Math.sqrt((l + m) * (l - m));
    const vn = ((m === 0 ? -Math.SQRT2 : 1) * Math.sqrt((l + a - 1) * (l + a))) / 2;
    const wn = m === 0 ? 0 : -Math.sqrt((l - a - 1) * (l - a)) / 2;
    for (let n = -l; n <= l; ++n) {
      let sum = un === 0 ? 0 : un * p(0, m, n);
      if (m === 0) sum += vn * (p(1, 1, n) + p(-1, -1, n));
      else if (m === 1) sum += vn * Math.SQRT2 * p(1, 0, n);
      else if (m === -1) sum += vn * Math.SQRT2 * p(-1, 0, n);
      else if (m > 0) sum += vn * (p(1, m - 1, n) - p(-1, -m + 1, n));
      else sum += vn * (p(1, m + 1, n) + p(-1, -m - 1, n));
      if (wn !== 0)
        sum += wn * (m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, -m + 1, n));
      const edge = n === l || n === -l;
      out[(m + l) * width + n + l] =
        sum / Math.sqrt(edge ? 2 * l * (2 * l - 1) : (l + n) * (l - n));
    }
  }
}

/**
 * The rotation of functions on the sphere, band by band: what stood in direction s stands in R·s.
 * Made once for a matrix R, applied to any number of coefficient sets. No allocation after the
 * first use; 10 bands cost some 1,500 multiplications each.
 */
export class HarmonicRotation {
  readonly bands: number;
  private readonly blocks: Float64Array[] = [];

  /** @param bands the most that will be turned, 1 … 10 */
  constructor(bands: number = kMaxBands) {
    this.bands = bands;
    for (let l = 0; l < bands; ++l) this.blocks.push(new Float64Array((2 * l + 1) ** 2));
    this.blocks[0][0] = 1;
  }

  /** @param m a proper rotation, 9 numbers, row after row (dstFromSrc). */
  set(m: ArrayLike<number>): this {
    if (this.bands < 2) return this;
    const axis = [1, 2, 0];
    const band1 = this.blocks[1];
    for (let i = 0; i < 3; ++i)
      for (let j = 0; j < 3; ++j) band1[i * 3 + j] = m[axis[i] * 3 + axis[j]];
    for (let l = 2; l < this.bands; ++l)
      bandFromBelow(l, band1, this.blocks[l - 1], this.blocks[l]);
    return this;
  }

  /**
   * Turns `channels` interleaved functions of n bands ≤ this.bands: [coefficient][channel].
   * `from` and `to` must not be the same.
   */
  apply(
    from: ArrayLike<number>,
    to: Float64Array | Float32Array,
    bands: number,
    channels = 1,
  ): void {
    for (let l = 0; l < bands; ++l) {
      const first = l * l;
      const width = 2 * l + 1;
      const block = this.blocks[l];
      for (let m = 0; m < width; ++m)
        for (let c = 0; c < channels; ++c) {
          let sum = 0;
          for (let n = 0; n < width; ++n)
            sum += block[m * width + n] * from[(first + n) * channels + c];
          to[(first + m) * channels + c] = sum;
        }
    }
  }
}

/** Row after row, from a unit quaternion. */
export function matrixOfQuaternion(q: { x: number; y: number; z: number; w: number }): number[] {
  const length = Math.hypot(q.x, q.y, q.z, q.w);
  if (!(length > 0)) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const x = q.x / length;
  const y = q.y / length;
  const z = q.z / length;
  const w = q.w / length;
  return [
    1 - 2 * (y * y + z * z),
    2 * (x * y - w * z),
    2 * (x * z + w * y),
    2 * (x * y + w * z),
    1 - 2 * (x * x + z * z),
    2 * (y * z - w * x),
    2 * (x * z - w * y),
    2 * (y * z + w * x),
    1 - 2 * (x * x + y * y),
  ];
}
