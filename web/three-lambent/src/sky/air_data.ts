// What the air does before things that are seen through it, of a viewer on the ground, from the few
// numbers of data/air.bin (web/sky_data/compact_air.h says what they are).
//
// Decode → mix → refine: what the factors give are logarithms at coarse nodes, between which cubics lead
// to the nodes of a table as lambent/sky/aerial_table.h has it, that shaders look up.

import { rgbOfXyz } from "./color.js";
import { Factors, type FactorsHeader } from "./factors.js";
import { cubicTaps, type Taps } from "./grids.js";
import { PackedNumbers } from "./packed_numbers.js";

interface Header extends FactorsHeader {
  azimuths: number;
  below: number;
  above: number;
  distances: number;
  floor: number;
  noHaze: number;
  radius: number;
  height: number;
  asymmetry: number;
}

/** Nodes of the table: sky::AirTableSize. */
export const kAirSize = { azimuths: 13, elevations: 48, distances: 16 } as const;
export const kElevationPower = 3;
export const kDistancePower = 2.5;
const kLeastReach = 2000; // m

/** For one place of the Sun, at one astronomical unit. */
export interface AirTableData {
  /**
   * Texels of four numbers: [distance][elevation][column][4]; columns are the azimuths of the sources
   * of air, of aerosols and of light scattered more than once, then the extinction.
   */
  texels: Float32Array;
  /** Of the planet, and of the air above it; metres. */
  radius: number;
  height: number;
  /** Of Cornette and Shanks's phase function. */
  asymmetry: number;
}

/** Distance to the end of a ray from the ground, m: sky::AirTableAxes::reach. */
export function airReach(radius: number, height: number, above: boolean, sine: number): number {
  if (!above) return kLeastReach;
  const b = radius * sine;
  const c = height * (2 * radius + height);
  return c / (Math.sqrt(b * b + c) + b);
}

/** One axis of nodes to another: [outer][from][inner] → [outer][to][inner]. */
function refined(from: Float32Array, inner: number, count: number, taps: readonly Taps[]): Float32Array {
  const outer = from.length / (inner * count);
  const out = new Float32Array(outer * taps.length * inner);
  let to = 0;
  for (let o = 0; o < outer; ++o)
    for (const { first, weight } of taps)
      for (let i = 0; i < inner; ++i, ++to) {
        const at = (o * count + first) * inner + i;
        out[to] =
          weight[0] * from[at] +
          weight[1] * from[at + inner] +
          weight[2] * from[at + 2 * inner] +
          weight[3] * from[at + 3 * inner];
      }
  return out;
}

/** Even nodes to others along the same axis. */
const evenTaps = (from: number, to: number): Taps[] =>
  Array.from({ length: to }, (_, i) => cubicTaps((i / (to - 1)) * (from - 1), from));

export class AirData {
  private readonly header: Header;
  private readonly factors: Factors;
  private readonly azimuthTaps: Taps[];
  private readonly rowTaps: Taps[];
  private readonly distanceTaps: Taps[];

  /** @throws Error if the bytes are something else */
  constructor(bytes: ArrayBuffer) {
    const numbers = new PackedNumbers<Header>(bytes, "lambair1", "data/air.bin");
    const h = (this.header = numbers.header);
    const columns = (9 * h.azimuths + 3) * (h.below + h.above) * h.distances;
    this.factors = new Factors(numbers, columns, 2);
    const half = kAirSize.elevations / 2;
    this.azimuthTaps = evenTaps(h.azimuths, kAirSize.azimuths);
    const above = evenTaps(h.above, half).map(({ first, weight }) => ({
      first: first + h.below,
      weight,
    }));
    this.rowTaps = [...evenTaps(h.below, half), ...above];
    this.distanceTaps = evenTaps(h.distances, kAirSize.distances);
  }

  /**
   * @param turbidity 1 … 10
   * @param sunElevation radians, −18° … 90°
   */
  table(turbidity: number, sunElevation: number): AirTableData {
    const h = this.header;
    const haze = turbidity - h.noHaze;
    const row = this.factors.at(turbidity, sunElevation);
    const rows = h.below + h.above;
    const along = (values: Float32Array, azimuths: number) => {
      const wide = azimuths > 1 ? refined(values, 1, h.azimuths, this.azimuthTaps) : values;
      return refined(
        refined(wide, azimuths, rows, this.rowTaps),
        azimuths * kAirSize.elevations,
        h.distances,
        this.distanceTaps,
      );
    };
    const coarse = h.distances * rows * h.azimuths;
    const parts = Array.from({ length: 9 }, (_, p) =>
      along(row.subarray(p * coarse, (p + 1) * coarse), kAirSize.azimuths),
    );
    const thin = h.distances * rows;
    const extinction = [0, 1, 2].map((c) =>
      along(row.subarray(9 * coarse + c * thin, 9 * coarse + (c + 1) * thin), 1),
    );
    return {
      texels: this.texelsOf(parts, extinction, haze),
      radius: h.radius,
      height: h.height,
      asymmetry: h.asymmetry,
    };
  }

  private texelsOf(
    parts: readonly Float32Array[],
    extinction: readonly Float32Array[],
    haze: number,
  ): Float32Array<ArrayBuffer> {
    const { azimuths, elevations, distances } = kAirSize;
    const width = 3 * azimuths + 1;
    const texels = new Float32Array(4 * width * elevations * distances);
    const shares = [0, 0, 0];
    const rgb = [0, 0, 0];
    for (let line = 0; line < elevations * distances; ++line) {
      this.sharesOfLoss(line, extinction, shares);
      const to = 4 * width * line;
      for (let c = 0; c < 3; ++c) texels[to + 12 * azimuths + c] = extinction[c][line];
      for (let i = 0; i < azimuths; ++i) {
        const node = line * azimuths + i;
        const put = (source: number, factors: readonly [number, number, number]) => {
          const [x, y, z] = factors;
          rgbOfXyz(x * multiple[0], y * multiple[1], z * multiple[2], rgb);
          for (let c = 0; c < 3; ++c)
            texels[to + 4 * (source * azimuths + i) + c] = rgb[c] * shares[c];
        };
        const multiple = [0, 1, 2].map((c) => Math.exp(parts[c][node]));
        const part = (p: number, scale: number) =>
          [0, 1, 2].map(
            (c) => scale * Math.max(0, Math.exp(parts[3 * p + c][node]) - this.header.floor),
          ) as [number, number, number];
        put(0, part(1, 1));
        put(1, part(2, haze));
        put(2, [1, 1, 1]);
      }
    }
    return texels;
  }

  /** What is lost of green on the way to the nodes of a line, over what is lost of each channel. */
  private sharesOfLoss(line: number, extinction: readonly Float32Array[], out: number[]): void {
    const { elevations, distances } = kAirSize;
    const half = elevations / 2;
    const elevation = line % elevations;
    const above = elevation >= half;
    const place = (elevation - (above ? half : 0)) / (half - 1);
    const sine = Math.sin((Math.PI / 2) * place ** kElevationPower);
    const reach = airReach(this.header.radius, this.header.height, above, sine);
    const distance = Math.floor(line / elevations);
    // The first node stands for the limit.
    const metres = reach * (Math.max(distance, 0.06) / (distances - 1)) ** kDistancePower;
    const lost = extinction.map((values) => -Math.expm1(-metres * Math.exp(values[line])));
    for (let c = 0; c < 3; ++c) out[c] = lost[1] / lost[c];
  }
}
