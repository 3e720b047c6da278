// Rows of numbers as texels: transfer is a long list of rows (of vectors, of matrices), and a
// texture a few thousand texels wide. Every row begins at a whole texel and lies within one line of
// the texture, so that a shader finds it by one division and reads on from there.

import {
  ByteType,
  DataArrayTexture,
  FloatType,
  HalfFloatType,
  NearestFilter,
  RGBAFormat,
  RGBAIntegerFormat,
  RedFormat,
  UnsignedByteType,
  UnsignedIntType,
  type PixelFormat,
  type TextureDataType,
} from "three";
import type { Numbers } from "../format/description.js";

// What every WebGL2 device takes; wider or higher layers would gain nothing.
const kSide = 2048;
const kLayers = 256;

/** Where rows stand in the layers of an array texture. */
export interface RowLayout {
  texelsARow: number;
  rowsALine: number;
  linesALayer: number;
  layers: number;
}

/** @throws Error if the rows do not fit into any texture */
export function layOutRows(rows: number, texelsARow: number, what: string): RowLayout {
  const rowsALine = Math.max(1, Math.min(Math.floor(kSide / texelsARow), rows));
  const lines = Math.max(1, Math.ceil(rows / rowsALine));
  const layers = Math.ceil(lines / kSide);
  if (texelsARow > kSide || layers > kLayers)
    throw new Error(`${what}: ${rows} rows of ${texelsARow} texels are more than WebGL2 can hold`);
  return { texelsARow, rowsALine, linesALayer: Math.ceil(lines / layers), layers };
}

/** Texels of all layers, the unused ones at the end included. */
export function texelsOf(layout: RowLayout): number {
  return layout.texelsARow * layout.rowsALine * layout.linesALayer * layout.layers;
}

/** What the shaders' `rowPlace` wants to know: rows a line, lines a layer, texels a row. */
export function layoutUniform(layout: RowLayout): Int32Array {
  return Int32Array.of(layout.rowsALine, layout.linesALayer, layout.texelsARow);
}

type TexelData = Float32Array | Uint16Array | Int8Array | Uint32Array | Uint8Array;

/**
 * Of four numbers in a texel, but of one where they are unsigned bytes (0 … 1 in shaders).
 *
 * An array texture that forgets its pixels once they are on the GPU: after a lost context it is to be
 * made again from the file's own bytes.
 */
export function makeRowTexture(data: TexelData, layout: RowLayout): DataArrayTexture {
  const { texelsARow, rowsALine, linesALayer, layers } = layout;
  const texture = new DataArrayTexture(
    data as unknown as Float32Array<ArrayBuffer>,
    texelsARow * rowsALine,
    linesALayer,
    layers,
  );
  const [format, type, name]: [PixelFormat, TextureDataType, string] =
    data instanceof Float32Array
      ? [RGBAFormat, FloatType, "RGBA32F"]
      : data instanceof Uint16Array
        ? [RGBAFormat, HalfFloatType, "RGBA16F"]
        : data instanceof Int8Array
          ? [RGBAFormat, ByteType, "RGBA8_SNORM"]
          : data instanceof Uint8Array
            ? [RedFormat, UnsignedByteType, "R8"]
            : [RGBAIntegerFormat, UnsignedIntType, "RGBA32UI"];
  texture.format = format;
  texture.type = type;
  texture.internalFormat = name as typeof texture.internalFormat;
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.unpackAlignment = 1;
  texture.onUpdate = () => {
    (texture.image as { data: unknown }).data = null;
  };
  texture.needsUpdate = true;
  return texture;
}

/**
 * Rows of `columns` numbers, four in a texel, the rest of the last one 0. As the file has them:
 * nothing is decoded, and nothing copied if the rows fill their texels and the texels the texture.
 */
export function textureOfRows(
  data: Numbers["data"],
  columns: number,
  what: string,
): { texture: DataArrayTexture; layout: RowLayout } {
  const rows = data.length / columns;
  const layout = layOutRows(rows, Math.ceil(columns / 4), what);
  const size = 4 * texelsOf(layout);
  if (size === data.length) return { texture: makeRowTexture(data, layout), layout };
  const make = data.constructor as new (length: number) => Numbers["data"];
  const padded = new make(size);
  const stride = 4 * layout.texelsARow;
  if (stride === columns) {
    padded.set(data);
  } else {
    for (let row = 0, from = 0; row < rows; ++row)
      for (let to = row * stride, end = to + columns; to < end; ++to) padded[to] = data[from++];
  }
  return { texture: makeRowTexture(padded, layout), layout };
}
