// The simulated sky of the library's preset "clear" at every turbidity and place of the Sun, from the
// few numbers of data/sky.bin (web/sky_data/compact_table.h says what they are).
//
// Decode → mix → refine: weights of the components are splines along the Sun's elevation and cubics
// along the logarithm of turbidity; what they give are logarithms of colours at coarse nodes, between
// which cubics lead to the dome's grid. As lambent/sky/sky_table.cpp.

import { cornetteShanks } from "./phase_functions.js";
import { rgbOfXyz } from "./color.js";
import {
  cubicTaps,
  domeAzimuth,
  domeElevation,
  kDomeColumns,
  kDomeRows,
  type DomeGrid,
  type Taps,
} from "./grids.js";
import { Factors, type FactorsHeader } from "./factors.js";
import type { MeasuredTables } from "./measured_skies.js";
import { PackedNumbers } from "./packed_numbers.js";

interface Header extends FactorsHeader {
  above: number;
  azimuths: number;
  floor: number;
  noHaze: number;
  sunNodes: number;
  sunStep: number;
  measured: MeasuredTables;
}

type Triple = [number, number, number];

const kAsymmetry = 0.7; // of the aerosols' phase function

export class SkyData {
  private readonly header: Header;
  private readonly factors: Factors;
  private readonly suns: Float64Array;
  private readonly plainSuns: Float64Array;
  private readonly rowTaps: Taps[];
  private readonly columnTaps: Taps[];
  // Held for the next sky.
  private readonly rows: Float32Array;

  /** @throws Error if the bytes are something else */
  constructor(bytes: ArrayBuffer) {
    const numbers = new PackedNumbers<Header>(bytes, "lambsky1", "data/sky.bin");
    const h = (this.header = numbers.header);
    this.factors = new Factors(numbers, 3 * (2 * h.above * h.azimuths + 1), 1);
    this.suns = numbers.take(3 * h.turbidities * h.sunNodes, h.sunStep);
    this.plainSuns = numbers.take(3 * h.turbidities * h.sunNodes, h.sunStep);
    this.rowTaps = Array.from({ length: kDomeRows }, (_, r) =>
      cubicTaps((r / (kDomeRows - 1)) * (h.above - 1), h.above),
    );
    this.columnTaps = Array.from({ length: kDomeColumns }, (_, c) =>
      cubicTaps((domeAzimuth(c) / Math.PI) * (h.azimuths - 1), h.azimuths),
    );
    this.rows = new Float32Array(6 * h.azimuths);
  }

  /** Of the models that know a sky by its irradiances. */
  get measured(): MeasuredTables {
    return this.header.measured;
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
    const coarse = this.factors.at(turbidity, sunElevation);
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
        const phase = haze * cornetteShanks(kAsymmetry, up + level * Math.cos(domeAzimuth(c)));
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
    const haze = this.factors.turbidityTaps(turbidity);
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
