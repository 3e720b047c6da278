// The simulated sky of the library's preset "clear" at every turbidity and place of the Sun, from the
// few numbers of data/sky.bin (web/sky_data/compact_table.h says what they are).
//
// Decode → mix → refine: weights of the components are splines along the Sun's elevation and cubics
// along the logarithm of turbidity; what they give are logarithms of colours at coarse nodes, between
// which cubics lead to the dome's grid. As lambent/sky/sky_table.cpp.

import { rgbOfXyz } from "./color.js";
import {
  cubicTaps,
  domeAzimuth,
  domeElevation,
  kDomeColumns,
  kDomeRows,
  makeSplines,
  splineTaps,
  type DomeGrid,
  type Taps,
} from "./grids.js";

interface Header {
  turbidities: number;
  logTurbidityStep: number;
  suns: number;
  above: number;
  azimuths: number;
  step: number;
  weightSteps: number[];
  floor: number;
  noHaze: number;
  sunNodes: number;
  sunStep: number;
}

type Triple = [number, number, number];

const kMagic = "lambsky1";
const kAsymmetry = 0.7; // of the aerosols' phase function, Cornette and Shanks's

/** Aerosols' phase function, 1/sr. */
export function aerosolPhase(cosine: number): number {
  const g = kAsymmetry;
  const reach = 1 + g * g - 2 * g * cosine;
  return (
    ((3 / (8 * Math.PI)) * (1 - g * g) * (1 + cosine * cosine)) /
    ((2 + g * g) * reach * Math.sqrt(reach))
  );
}

/** Where a Sun stands among the nodes (radians): 5° between them by day, less in twilight. */
export function sunCoordinate(elevation: number): number {
  const kTwilight = 1.6; // nodes to a degree
  const at = (degrees: number) => {
    const past = degrees - 78;
    return degrees / 5 + ((kTwilight - 0.2) / 2) * (past + Math.sqrt(past * past + 64));
  };
  return at(90 - (elevation * 180) / Math.PI) - at(0);
}

/** How much light, X, Y, Z in lx. */
export interface Irradiances {
  /** Of the ground by the dome. */
  diffuse: Triple;
  /** Of a surface that faces the Sun, with all of its disc above the horizon. */
  sun: Triple;
}

export class SkyData {
  private readonly header: Header;
  private readonly columns: number;
  private readonly mean: Float32Array;
  private readonly basis: Float32Array[];
  /** [component][turbidity][Sun], of splines along the Sun's axis. */
  private readonly weights: Float64Array;
  private readonly suns: Float64Array;
  private readonly plainSuns: Float64Array;
  private readonly rowTaps: Taps[];
  private readonly columnTaps: Taps[];
  // Held for the next sky.
  private readonly coarse: Float32Array;
  private readonly rows: Float32Array;

  /** @throws Error if the bytes are something else */
  constructor(bytes: ArrayBuffer) {
    const view = new DataView(bytes);
    const text = (from: number, length: number) =>
      new TextDecoder().decode(new Uint8Array(bytes, from, length));
    if (bytes.byteLength < 12 || text(0, 8) !== kMagic)
      throw new Error("LambentSky: these bytes are not three-lambent's data/sky.bin");
    const length = view.getUint32(8, true);
    if (length > bytes.byteLength - 12) throw new Error("LambentSky: data/sky.bin is cut short");
    const h = (this.header = JSON.parse(text(12, length)) as Header);
    this.columns = 3 * (2 * h.above * h.azimuths + 1);
    let at = 12 + length;
    const all = new Uint8Array(bytes);
    const take = (count: number, scale: number) => {
      const out = new Float64Array(count);
      let sum = 0;
      for (let i = 0; i < count; ++i) {
        let [bits, factor, byte] = [0, 1, 128];
        for (; byte & 128; factor *= 128) {
          if (at >= all.length) throw new Error("LambentSky: data/sky.bin is cut short");
          byte = all[at++];
          bits += (byte & 127) * factor;
        }
        sum += bits % 2 ? -(bits + 1) / 2 : bits / 2;
        out[i] = sum * scale;
      }
      return out;
    };
    this.mean = Float32Array.from(take(this.columns, h.step));
    this.basis = [];
    this.weights = new Float64Array(h.weightSteps.length * h.turbidities * h.suns);
    h.weightSteps.forEach((step, k) => {
      this.basis.push(Float32Array.from(take(this.columns, h.step)));
      const count = h.turbidities * h.suns;
      this.weights.set(take(count, step), k * count);
    });
    for (let i = 0; i < this.weights.length; i += h.suns)
      makeSplines(this.weights.subarray(i, i + h.suns));
    this.suns = take(3 * h.turbidities * h.sunNodes, h.sunStep);
    this.plainSuns = take(3 * h.turbidities * h.sunNodes, h.sunStep);
    this.rowTaps = Array.from({ length: kDomeRows }, (_, r) =>
      cubicTaps((r / (kDomeRows - 1)) * (h.above - 1), h.above),
    );
    this.columnTaps = Array.from({ length: kDomeColumns }, (_, c) =>
      cubicTaps((domeAzimuth(c) / Math.PI) * (h.azimuths - 1), h.azimuths),
    );
    this.coarse = new Float32Array(this.columns);
    this.rows = new Float32Array(6 * h.azimuths);
  }

  private turbidityTaps(turbidity: number): Taps {
    const { logTurbidityStep, turbidities } = this.header;
    return cubicTaps(Math.log(turbidity) / logTurbidityStep, turbidities);
  }

  /** Logarithms at the coarse nodes, into `coarse`. */
  private mix(turbidity: number, sunElevation: number): Float32Array {
    const { turbidities, suns } = this.header;
    const haze = this.turbidityTaps(turbidity);
    const sun = splineTaps(sunCoordinate(sunElevation), suns);
    const { coarse, basis } = this;
    coarse.set(this.mean);
    for (let k = 0; k < basis.length; ++k) {
      let weight = 0;
      for (let i = 0; i < 4; ++i)
        for (let j = 0; j < 4; ++j)
          weight +=
            haze.weight[i] *
            sun.weight[j] *
            this.weights[(k * turbidities + haze.first + i) * suns + sun.first + j];
      const from = basis[k];
      for (let i = 0; i < coarse.length; ++i) coarse[i] += weight * from[i];
    }
    return coarse;
  }

  /**
   * The dome, for a Sun at one astronomical unit, and the irradiance of the ground by it.
   *
   * @param turbidity 1 … 10
   * @param sunElevation radians, −18° … 90°
   */
  dome(turbidity: number, sunElevation: number): { grid: DomeGrid; diffuse: Triple } {
    const { above, azimuths, floor, noHaze } = this.header;
    const haze = turbidity - noHaze;
    const coarse = this.mix(turbidity, sunElevation);
    const nodes = above * azimuths;
    const grid = new Float32Array(3 * kDomeRows * kDomeColumns);
    const { rows } = this;
    const [sine, cosine] = [Math.sin(sunElevation), Math.cos(sunElevation)];
    const xyz = [0, 0, 0];
    const rgb = [0, 0, 0];
    for (let r = 0; r < kDomeRows; ++r) {
      const along = this.rowTaps[r];
      for (let part = 0; part < 6; ++part)
        for (let a = 0; a < azimuths; ++a) {
          let sum = 0;
          for (let k = 0; k < 4; ++k)
            sum += along.weight[k] * coarse[part * nodes + (along.first + k) * azimuths + a];
          rows[part * azimuths + a] = sum;
        }
      const elevation = domeElevation(r);
      const [up, level] = [Math.sin(elevation) * sine, Math.cos(elevation) * cosine];
      for (let c = 0; c < kDomeColumns; ++c) {
        const phase = haze * aerosolPhase(up + level * Math.cos(domeAzimuth(c)));
        const { first, weight } = this.columnTaps[c];
        const at = (part: number) => {
          const from = part * azimuths + first;
          return (
            weight[0] * rows[from] +
            weight[1] * rows[from + 1] +
            weight[2] * rows[from + 2] +
            weight[3] * rows[from + 3]
          );
        };
        for (let i = 0; i < 3; ++i)
          xyz[i] = Math.exp(at(i)) * (1 + phase * Math.max(0, Math.exp(at(3 + i)) - floor));
        rgbOfXyz(xyz[0], xyz[1], xyz[2], rgb);
        grid.set(rgb, 3 * (r * kDomeColumns + c));
      }
    }
    const diffuse = [0, 1, 2].map((i) => Math.exp(coarse[6 * nodes + i])) as Triple;
    return { grid, diffuse };
  }

  /** X, Y, Z (lx) on a surface that faces the Sun, all of whose disc is above the horizon. */
  sun(turbidity: number, sunElevation: number): Triple {
    return this.sunOf(this.suns, turbidity, sunElevation);
  }
  /** The same, as the analytic models have it. */
  plainSun(turbidity: number, sunElevation: number): Triple {
    return this.sunOf(this.plainSuns, turbidity, sunElevation);
  }
  private sunOf(table: Float64Array, turbidity: number, elevation: number): Triple {
    const { sunNodes } = this.header;
    const t = Math.sqrt(Math.max(0, elevation) / (Math.PI / 2));
    const high = cubicTaps(t * (sunNodes - 1), sunNodes);
    const haze = this.turbidityTaps(turbidity);
    const out: Triple = [0, 0, 0];
    for (let c = 0; c < 3; ++c) {
      let sum = 0;
      for (let i = 0; i < 4; ++i)
        for (let j = 0; j < 4; ++j)
          sum +=
            haze.weight[i] *
            high.weight[j] *
            table[((haze.first + i) * 3 + c) * sunNodes + high.first + j];
      out[c] = Math.exp(sum);
    }
    return out;
  }
}
