// A dome's grid as harmonics and as a texture: the light and what is seen are the same numbers.

import { DataTexture, FloatType, NearestFilter, RGBAFormat } from "three";
import { evaluateHarmonics, kMaxBands } from "../sh/basis.js";
import { gaussLegendre } from "../sh/quadrature.js";
import { HarmonicRotation } from "../sh/rotation.js";
import { withinGamut } from "./color.js";
import { domeAzimuth, kDomeColumns, kDomeRows, type DomeGrid } from "./grids.js";

const kCount = kMaxBands * kMaxBands;

/** ∫ hat_row y_lm(cos, 0, sin) cos e de at azimuth 0, up along +z: [row][coefficient], m ≥ 0. */
function makeRowWeights(): Float64Array {
  const weights = new Float64Array(kDomeRows * kCount);
  const rule = gaussLegendre(6, 0, 1);
  const basis = new Float64Array(kCount);
  for (let r = 0; r + 1 < kDomeRows; ++r)
    for (let k = 0; k < rule.nodes.length; ++k) {
      const share = rule.nodes[k];
      const t = (r + share) / (kDomeRows - 1);
      const elevation = (Math.PI / 2) * t * t;
      const cosine = Math.cos(elevation);
      evaluateHarmonics(kMaxBands, cosine, 0, Math.sin(elevation), basis);
      const w = (rule.weights[k] * Math.PI * t * cosine) / (kDomeRows - 1);
      for (let i = 0; i < kCount; ++i) {
        weights[r * kCount + i] += w * (1 - share) * basis[i];
        weights[(r + 1) * kCount + i] += w * share * basis[i];
      }
    }
  return weights;
}

/** cos mφ over the full turn, of which the columns are half: [column][m]. */
function makeCosines(): Float64Array {
  const cosines = new Float64Array(kDomeColumns * kMaxBands);
  for (let c = 0; c < kDomeColumns; ++c)
    for (let m = 0; m < kMaxBands; ++m)
      cosines[c * kMaxBands + m] = ((2 * Math.PI) / kDomeColumns) * Math.cos(m * domeAzimuth(c));
  return cosines;
}

let rowWeights: Float64Array | null = null;
let cosines: Float64Array | null = null;

/** ∫ dome y_i ds in 10 bands, [coefficient][3], with the Sun towards a compass bearing (radians). */
export function projectDome(grid: DomeGrid, bearing: number): Float64Array {
  rowWeights ??= makeRowWeights();
  cosines ??= makeCosines();
  const polar = new Float64Array(3 * kCount);
  const sums = new Float64Array(3 * kMaxBands);
  for (let r = 0; r < kDomeRows; ++r) {
    sums.fill(0);
    for (let c = 0; c < kDomeColumns; ++c) {
      const at = 3 * (r * kDomeColumns + c);
      for (let m = 0; m < kMaxBands; ++m) {
        const cosine = cosines[c * kMaxBands + m];
        sums[3 * m] += cosine * grid[at];
        sums[3 * m + 1] += cosine * grid[at + 1];
        sums[3 * m + 2] += cosine * grid[at + 2];
      }
    }
    for (let m = 0; m < kMaxBands; ++m)
      for (let l = m; l < kMaxBands; ++l) {
        const i = l * (l + 1) + m;
        const weight = rowWeights[r * kCount + i];
        for (let c = 0; c < 3; ++c) polar[3 * i + c] += weight * sums[3 * m + c];
      }
  }
  // (x, y, z) of the sums' frame lies at (x, z, −y) of the Sun's, which is turned about +y.
  const [east, south] = [Math.sin(bearing), -Math.cos(bearing)];
  const out = new Float64Array(3 * kCount);
  new HarmonicRotation(kMaxBands)
    .set([east, south, 0, 0, 0, 1, south, -east, 0])
    .apply(polar, out, kMaxBands, 3);
  return out;
}

/** For EnvironmentSky, within the gamut. */
export function domeTexture(grid: DomeGrid): DataTexture {
  const width = 2 * kDomeColumns;
  const data = new Float32Array(4 * width * kDomeRows);
  for (let r = 0; r < kDomeRows; ++r)
    for (let x = 0; x < width; ++x) {
      const column = x < kDomeColumns ? kDomeColumns - 1 - x : x - kDomeColumns;
      const from = 3 * (r * kDomeColumns + column);
      const to = 4 * (r * width + x);
      data.set(withinGamut([grid[from], grid[from + 1], grid[from + 2]]), to);
      data[to + 3] = 1;
    }
  const texture = new DataTexture(data, width, kDomeRows, RGBAFormat, FloatType);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
