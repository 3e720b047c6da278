// This work is based on:
// - sloan2002precomputed: eq. 5, the real basis (here with positive signs throughout).
// - press2007numerical: §6.7, the recurrence over l of normalised Legendre functions at fixed m.
//
// Real, orthonormal, polar axis +z, positive signs, index l(l+1)+m: as lambent/sh/basis.h and
// shaders/sh.glsl. A table test holds the three together.

/** Bands that light and transfer may have. */
export const kMaxBands = 10;

/** The number of coefficients of a function of `bands` bands. */
export function coefficientCount(bands: number): number {
  return bands * bands;
}

/** The band of a coefficient: l of index l(l+1)+m. */
export function bandOf(index: number): number {
  return Math.floor(Math.sqrt(index));
}

/** The bands of `count` coefficients; 0 if that is no square of 1 … 10. */
export function bandsOf(count: number): number {
  const bands = Math.round(Math.sqrt(count));
  return bands >= 1 && bands <= kMaxBands && bands * bands === count ? bands : 0;
}

/**
 * All basis functions in one direction.
 *
 * @param bands 1 … 10
 * @param x of a unit direction, as y and z
 * @param out bands² numbers are written
 */
export function evaluateHarmonics<T extends Float64Array | Float32Array | number[] = Float64Array>(
  bands: number,
  x: number,
  y: number,
  z: number,
  out: T = new Float64Array(bands * bands) as unknown as T,
): T {
  let cosine = 1;
  let sine = 0;
  let sectoral = Math.sqrt(1 / (4 * Math.PI));
  for (let m = 0; m < bands; ++m) {
    let before = 0;
    let p = sectoral;
    for (let l = m; l < bands; ++l) {
      if (m === 0) {
        out[l * (l + 1)] = p;
      } else {
        out[l * (l + 1) + m] = Math.SQRT2 * p * cosine;
        out[l * (l + 1) - m] = Math.SQRT2 * p * sine;
      }
      const next = (l + 1) * (l + 1);
      const a = Math.sqrt((4 * next - 1) / (next - m * m));
      const b = l > m ? Math.sqrt((l * l - m * m) / (4 * l * l - 1)) : 0;
      const after = a * (z * p - b * before);
      before = p;
      p = after;
    }
    const turned = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = turned;
    sectoral *= Math.sqrt((2 * m + 3) / (2 * m + 2));
  }
  return out;
}
