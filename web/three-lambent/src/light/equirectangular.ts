// An environment map in latitude and longitude → harmonics, exactly: the projection of the bilinear
// interpolant of the pixels' centres, which wraps around in azimuth and is constant in the half
// pixel next to a pole. The function is separable, so that a row needs only its Fourier sums over
// azimuth, and the rows' elevations a small quadrature each:
//   f_lm = Σ_rows W_row,l|m| · Δφ sinc²(mΔφ/2) Σ_x pixel_x {cos, sin} mφ_x
// where sinc² is the transform of the linear interpolation's hat; then one rotation from the image's
// pole (+y) to that of the harmonics (+z). As lambent/light/lat_long.cpp.

import { floatFromHalf } from "../format/half.js";
import { srgbDecode } from "../output/tone.js";
import { evaluateHarmonics } from "../sh/basis.js";
import { gaussLegendre } from "../sh/quadrature.js";
import { HarmonicRotation } from "../sh/rotation.js";

/** Pixels of a map in latitude and longitude: u = atan2(z, x)/2π + ½, elevation = π(½ − v). */
export interface EquirectangularImage {
  data: ArrayLike<number>;
  /** Pixels. */
  width: number;
  height: number;
  /** Numbers of a pixel, of which the first three are R, G, B. */
  channels: 3 | 4;
  /** "float32": radiance; "float16": bit patterns; "srgb8": 0 … 255, sRGB code values. */
  encoding: "float32" | "float16" | "srgb8";
  /** Whether row 0 is that of the zenith. */
  topRowFirst: boolean;
}

/** ∫ hat_y y_lm(cos, 0, sin) cos(elevation) d elevation: [row][coefficient], m ≥ 0. */
function rowWeights(height: number, bands: number): Float64Array {
  const count = bands * bands;
  const weights = new Float64Array(height * count);
  const basis = new Float64Array(count);
  // Polynomials in sine and cosine of degree `bands` times a linear function.
  const nodes = height < 64 ? 24 : 6;
  const clamp = (row: number) => Math.min(Math.max(row, 0), height - 1);
  for (let r = 0; r <= height; ++r) {
    const top = Math.max(0, (r - 0.5) / height);
    const bottom = Math.min(1, (r + 0.5) / height);
    const rule = gaussLegendre(nodes, top, bottom);
    const above = clamp(r - 1) * count;
    const below = clamp(r) * count;
    for (let k = 0; k < nodes; ++k) {
      const elevation = Math.PI * (0.5 - rule.nodes[k]);
      const cosine = Math.cos(elevation);
      evaluateHarmonics(bands, cosine, 0, Math.sin(elevation), basis);
      const w = rule.weights[k] * Math.PI * cosine;
      const share = rule.nodes[k] * height + 0.5 - r;
      for (let i = 0; i < count; ++i) {
        weights[above + i] += w * (1 - share) * basis[i];
        weights[below + i] += w * share * basis[i];
      }
    }
  }
  return weights;
}

/** [coefficient][3]. What is not finite counts as black. */
export function projectEquirectangular(image: EquirectangularImage, bands: number): Float64Array {
  const { data, width, height, channels, encoding, topRowFirst } = image;
  if (!(width >= 1 && height >= 1) || data.length < width * height * channels)
    throw new Error(
      `an environment of ${width}×${height} pixels × ${channels} needs ` +
        `${width * height * channels} numbers, and has ${data.length}`,
    );
  const decode =
    encoding === "float16"
      ? floatFromHalf
      : encoding === "srgb8"
        ? (v: number) => srgbDecode(v / 255)
        : (v: number) => v;
  const count = bands * bands;
  const step = (2 * Math.PI) / width;
  const cosines = new Float64Array(bands * width);
  const sines = new Float64Array(bands * width);
  for (let m = 0; m < bands; ++m) {
    const half = 0.5 * m * step;
    const sinc = m ? Math.sin(half) / half : 1;
    for (let x = 0; x < width; ++x) {
      // The frame of the sums has its +z at the image's pole: its azimuth is −a.
      const angle = -m * 2 * Math.PI * ((x + 0.5) / width - 0.5);
      cosines[m * width + x] = step * sinc * sinc * Math.cos(angle);
      sines[m * width + x] = step * sinc * sinc * Math.sin(angle);
    }
  }
  const weights = rowWeights(height, bands);
  const polar = new Float64Array(3 * count);
  const row = new Float64Array(3 * width);
  for (let y = 0; y < height; ++y) {
    const from = (topRowFirst ? y : height - 1 - y) * width * channels;
    for (let x = 0; x < width; ++x)
      for (let c = 0; c < 3; ++c) {
        const value = decode(data[from + x * channels + c]);
        row[3 * x + c] = Number.isFinite(value) ? value : 0;
      }
    for (let m = 0; m < bands; ++m) {
      let [er, eg, eb, or, og, ob] = [0, 0, 0, 0, 0, 0];
      for (let x = 0; x < width; ++x) {
        const cosine = cosines[m * width + x];
        const sine = sines[m * width + x];
        const r = row[3 * x];
        const g = row[3 * x + 1];
        const b = row[3 * x + 2];
        er += cosine * r;
        eg += cosine * g;
        eb += cosine * b;
        or += sine * r;
        og += sine * g;
        ob += sine * b;
      }
      const even = [er, eg, eb];
      const odd = [or, og, ob];
      for (let l = m; l < bands; ++l) {
        const weight = weights[y * count + l * (l + 1) + m];
        for (let c = 0; c < 3; ++c) {
          polar[3 * (l * (l + 1) + m) + c] += weight * even[c];
          if (m) polar[3 * (l * (l + 1) - m) + c] += weight * odd[c];
        }
      }
    }
  }
  // imageFromPolar: (x, y, z) of the sums' frame lies at (x, z, −y) of the image's.
  const rotation = new HarmonicRotation(bands).set([1, 0, 0, 0, 0, 1, 0, -1, 0]);
  const out = new Float64Array(3 * count);
  rotation.apply(polar, out, bands, 3);
  return out;
}
