// Rows for each turbidity and place of the Sun as mean + Σ weight · basis: web/sky_data/factors.h.
// Weights are splines along the Sun's elevation and cubics along the logarithm of turbidity.

import { cubicTaps, makeSplines, splineTaps } from "./grids.js";
import type { PackedNumbers } from "./packed_numbers.js";

export interface FactorsHeader {
  turbidities: number;
  logTurbidityStep: number;
  suns: number;
  step: number;
  weightSteps: number[];
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

export class Factors {
  private readonly mean: Float32Array;
  private readonly basis: Float32Array[] = [];
  /** [component][turbidity][Sun], of splines along the Sun's axis. */
  private readonly weights: Float64Array;
  // Held for the next row.
  private readonly row: Float32Array;

  /** @param sunStep nodes of {@link sunCoordinate} from one Sun to the next */
  constructor(
    numbers: PackedNumbers<FactorsHeader>,
    columns: number,
    private readonly sunStep: number,
  ) {
    const h = (this.header = numbers.header);
    const count = h.turbidities * h.suns;
    this.mean = Float32Array.from(numbers.take(columns, h.step));
    this.weights = new Float64Array(h.weightSteps.length * count);
    h.weightSteps.forEach((step, k) => {
      this.basis.push(Float32Array.from(numbers.take(columns, h.step)));
      this.weights.set(numbers.take(count, step), k * count);
    });
    for (let i = 0; i < this.weights.length; i += h.suns)
      makeSplines(this.weights.subarray(i, i + h.suns));
    this.row = new Float32Array(columns);
  }
  private readonly header: FactorsHeader;

  turbidityTaps(turbidity: number) {
    const { logTurbidityStep, turbidities } = this.header;
    return cubicTaps(Math.log(turbidity) / logTurbidityStep, turbidities);
  }

  /** A row, which is good until the next one is asked for. */
  at(turbidity: number, sunElevation: number): Float32Array {
    const { turbidities, suns } = this.header;
    const haze = this.turbidityTaps(turbidity);
    const sun = splineTaps(sunCoordinate(sunElevation) / this.sunStep, suns);
    const { row, basis } = this;
    row.set(this.mean);
    for (let k = 0; k < basis.length; ++k) {
      let weight = 0;
      for (let i = 0; i < 4; ++i)
        for (let j = 0; j < 4; ++j)
          weight +=
            haze.weight[i] *
            sun.weight[j] *
            this.weights[(k * turbidities + haze.first + i) * suns + sun.first + j];
      const from = basis[k];
      for (let i = 0; i < row.length; ++i) row[i] += weight * from[i];
    }
    return row;
  }
}
