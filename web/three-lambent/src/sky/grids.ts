// Interpolation between even nodes, as lambent/sky/interpolation.h has it, and the grid of directions
// that a dome is held at.

/** The first of four neighbours among nodes, and their weights. */
export interface Taps {
  first: number;
  weight: readonly [number, number, number, number];
}

const clamp = (x: number, low: number, high: number) => Math.min(Math.max(x, low), high);

/** Lagrange's cubic through four of the nodes 0 … count − 1 (count ≥ 4). */
export function cubicTaps(coordinate: number, count: number): Taps {
  const x = clamp(coordinate, 0, count - 1);
  const first = clamp(Math.floor(x) - 1, 0, count - 4);
  const t = x - (first + 1);
  return {
    first,
    weight: [
      (-t * (t - 1) * (t - 2)) / 6,
      ((t + 1) * (t - 1) * (t - 2)) / 2,
      (-(t + 1) * t * (t - 2)) / 2,
      ((t + 1) * t * (t - 1)) / 6,
    ],
  };
}

/** The cubic B-spline of coefficients that {@link makeSplines} made; straight at both ends. */
export function splineTaps(coordinate: number, count: number): Taps {
  const x = clamp(coordinate, 0, count - 1);
  const cell = clamp(Math.floor(x), 0, count - 2);
  const t = x - cell;
  const s = 1 - t;
  const weight = [
    (s * s * s) / 6,
    (4 - 6 * t * t + 3 * t * t * t) / 6,
    (4 - 6 * s * s + 3 * s * s * s) / 6,
    (t * t * t) / 6,
  ];
  const first = clamp(cell - 1, 0, count - 4);
  const out: [number, number, number, number] = [0, 0, 0, 0];
  for (let k = 0; k < 4; ++k) {
    const node = cell - 1 + k;
    // Nodes beyond the ends go on in a straight line.
    if (node < 0) {
      out[0] += 2 * weight[k];
      out[1] -= weight[k];
    } else if (node >= count) {
      out[3] += 2 * weight[k];
      out[2] -= weight[k];
    } else {
      out[node - first] += weight[k];
    }
  }
  return { first, weight: out };
}

/** Values at nodes become the coefficients of the splines through them, in place. */
export function makeSplines(values: Float64Array): void {
  const count = values.length;
  const factor = new Float64Array(count);
  for (let n = 1; n + 1 < count; ++n) {
    factor[n] = 1 / (4 - (n > 1 ? factor[n - 1] : 0));
    values[n] = (6 * values[n] - values[n - 1]) * factor[n];
  }
  for (let n = count - 2; n >= 1; --n) values[n] -= factor[n] * values[n + 1];
}

/** Rows of {@link DomeGrid}: row r stands at the elevation π/2 (r/(rows − 1))². */
export const kDomeRows = 93;
/** Its columns over half a turn from the Sun on: column c stands at the azimuth (c + ½) π/columns. */
export const kDomeColumns = 72;

/**
 * Radiance above the horizon in the Sun's frame (+y up, the Sun towards +x), symmetric about the
 * plane of the Sun: [row][column][red, green, blue]. Channels may be below 0, out of the gamut.
 */
export type DomeGrid = Float32Array;

export const domeElevation = (row: number): number => (Math.PI / 2) * (row / (kDomeRows - 1)) ** 2;
export const domeAzimuth = (column: number): number => ((column + 0.5) * Math.PI) / kDomeColumns;
