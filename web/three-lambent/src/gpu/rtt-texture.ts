// A radiance transfer texture and the means of it over 2×2, 4×4 … positions, as texels that a
// fragment reads 16 bytes at a time: shade::makePyramid and render/gl_patches.cpp.
//
// This work is based on:
// - sloan2003biscale: §5; williams1983pyramidal: levels. Positions of a level share the period
//   evenly: where a width is odd, each gives by the share of it that is covered.

import type { DataArrayTexture } from "three";
import type { Numbers, RadianceTransferTexture } from "../format/description.js";
import { floatFromHalf, halfFromFloat } from "../format/half.js";
import { layOutRows, layoutUniform, makeRowTexture, texelsOf } from "./row-texture.js";

/** As the shader's `levels[16]`. */
const kMostLevels = 16;

/** LAMBENT_NUMBERS of shaders/rtt_response.glsl. */
export const kNumbersOf = { float32: 0, float16: 1, snorm8: 2 } as const;

/** Groups of four numbers in a texel of 16 bytes. */
export const kGroupsAFetch = { float32: 1, float16: 2, snorm8: 4 } as const;

/** Numbers of a position and view, in groups of four. */
export function groupsOf(coefficients: number): number {
  return Math.ceil((3 * coefficients) / 4);
}

interface Level {
  width: number;
  height: number;
  /** [coefficient][y][x][view][3]; bytes count 1 each. */
  values: Numbers["data"];
  /** [y][x][view] */
  heights: Uint8Array | null;
}

interface Span {
  first: number;
  weights: number[];
}

/** What a position of the next level takes, along one axis. */
function spans(from: number, to: number): Span[] {
  const ratio = from / to;
  return Array.from({ length: to }, (_, i) => {
    const begin = i * ratio;
    const end = (i + 1) * ratio;
    const first = Math.floor(begin + 1e-9);
    const weights: number[] = [];
    for (let k = first; k < from && k < end - 1e-9; ++k)
      weights.push((Math.min(end, k + 1) - Math.max(begin, k)) / ratio);
    return { first, weights };
  });
}

function halvedHeights(
  { width, heights }: Level,
  across: Span[],
  along: Span[],
  views: number,
): Uint8Array | null {
  if (!heights) return null;
  const means = new Float32Array(views);
  const out = new Uint8Array(across.length * along.length * views);
  let to = 0;
  for (const row of along)
    for (const column of across) {
      means.fill(0.5); // so that cutting off rounds
      for (let b = 0; b < row.weights.length; ++b)
        for (let a = 0; a < column.weights.length; ++a) {
          const weight = row.weights[b] * column.weights[a];
          const from = ((row.first + b) * width + column.first + a) * views;
          for (let v = 0; v < views; ++v) means[v] += weight * heights[from + v];
        }
      for (let v = 0; v < views; ++v) out[to++] = Math.min(means[v], 255);
    }
  return out;
}

function halved(fine: Level, coefficients: number, perPosition: number): Level {
  const width = Math.max(1, fine.width >> 1);
  const height = Math.max(1, fine.height >> 1);
  const values = new Float32Array(coefficients * width * height * perPosition);
  const across = spans(fine.width, width);
  const along = spans(fine.height, height);
  const half = fine.values instanceof Uint16Array;
  let to = 0;
  for (let i = 0; i < coefficients; ++i)
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x, to += perPosition)
        for (let b = 0; b < along[y].weights.length; ++b)
          for (let a = 0; a < across[x].weights.length; ++a) {
            const weight = along[y].weights[b] * across[x].weights[a];
            const row = i * fine.height + along[y].first + b;
            const from = (row * fine.width + across[x].first + a) * perPosition;
            for (let k = 0; k < perPosition; ++k) {
              const value = fine.values[from + k];
              values[to + k] += weight * (half ? floatFromHalf(value) : value);
            }
          }
  return { width, height, values, heights: halvedHeights(fine, across, along, perPosition / 3) };
}

export class RttTexture {
  readonly texture: DataArrayTexture;
  readonly rows: Int32Array;
  /** width, height, first position, 0 for each of 16. */
  readonly levels: Int32Array = new Int32Array(4 * kMostLevels);
  readonly levelCount: number;
  /** Of all levels, with their rows; null: views are not corrected. */
  readonly heights: { texture: DataArrayTexture; rows: Int32Array } | null = null;
  /** The patch's depth, in its periods along x and y. */
  readonly relief: Float32Array;

  constructor(readonly rtt: RadianceTransferTexture) {
    const coefficients = rtt.bands ** 2;
    const viewCount = rtt.views ** 2;
    const { encoding, data } = rtt.numbers;
    const pyramid: Level[] = [
      { width: rtt.width, height: rtt.height, values: data, heights: rtt.heights },
    ];
    let last = pyramid[0];
    while (pyramid.length < kMostLevels && (last.width > 1 || last.height > 1)) {
      last = halved(last, coefficients, 3 * viewCount);
      pyramid.push(last);
    }
    this.levelCount = pyramid.length;
    let positions = 0;
    pyramid.forEach((level, k) => {
      this.levels.set([level.width, level.height, positions, 0], 4 * k);
      positions += level.width * level.height;
    });

    const fetches = Math.ceil(groupsOf(coefficients) / kGroupsAFetch[encoding]);
    const what = `radiance transfer texture "${rtt.name}"`;
    const layout = layOutRows(positions * viewCount, fetches, what);
    const words = new Uint32Array(4 * texelsOf(layout));
    const make = data.constructor as new (buffer: ArrayBuffer) => Numbers["data"];
    const numbers = new make(words.buffer);
    const stride = (16 / data.BYTES_PER_ELEMENT) * fetches;
    pyramid.forEach((level, k) => {
      const first = this.levels[4 * k + 2];
      const places = level.width * level.height * viewCount;
      const convert =
        k === 0
          ? null
          : encoding === "snorm8"
            ? (v: number) => Math.sign(v) * Math.round(Math.abs(v))
            : encoding === "float16"
              ? halfFromFloat
              : null;
      let from = 0;
      for (let i = 0; i < coefficients; ++i) {
        let to = first * viewCount * stride + 3 * i;
        for (let place = 0; place < places; ++place, to += stride)
          for (let c = 0; c < 3; ++c, ++from)
            numbers[to + c] = convert ? convert(level.values[from]) : level.values[from];
      }
    });
    this.texture = makeRowTexture(words, layout);
    this.rows = layoutUniform(layout);
    this.relief = Float32Array.from(rtt.size, (period) => rtt.depth / period);
    if (!rtt.heights || !(rtt.depth > 0)) return;
    const ofHeights = layOutRows(positions * viewCount, 1, what);
    const heights = new Uint8Array(texelsOf(ofHeights));
    let first = 0;
    for (const level of pyramid) {
      heights.set(level.heights!, first);
      first += level.heights!.length;
    }
    const texture = makeRowTexture(heights, ofHeights);
    this.heights = { texture, rows: layoutUniform(ofHeights) };
  }

  /** What a stored number 1 stands for, coefficient by coefficient. */
  scales(): Float32Array {
    const out = new Float32Array(this.rtt.bands ** 2).fill(1);
    const { scales } = this.rtt.numbers;
    return scales ? out.map((_, i) => scales[i] / 127) : out;
  }

  dispose(): void {
    this.texture.dispose();
    this.heights?.texture.dispose();
  }
}
