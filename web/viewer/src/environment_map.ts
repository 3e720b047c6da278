// Files of light → pixels in latitude and longitude.
import { FloatType, RedFormat } from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import type { EquirectangularImage } from "three-lambent";
import { srgbDecode } from "three-lambent";
import { type Chromaticities, toRec709 } from "./primaries";
import { messageOf } from "./messages";

/** Linear radiance; four floats a pixel, the zenith's row first. */
export interface LightMap {
  width: number;
  height: number;
  data: Float32Array;
}

export const kLightExtensions = [".hdr", ".exr", ".png", ".jpg", ".jpeg", ".json"];

/** Reads a map by its file's extension. Throws an Error that says what is wrong with it. */
export async function decodeMap(bytes: ArrayBuffer, name: string): Promise<LightMap> {
  const extension = name.toLowerCase().match(/\.[a-z]+$/)?.[0] ?? "";
  let map: LightMap;
  try {
    if (extension === ".hdr") map = decodeHdr(bytes);
    else if (extension === ".exr") map = decodeExr(bytes);
    else map = await decodePicture(bytes);
  } catch (error) {
    const reason = messageOf(error);
    throw new Error(`${name}: damaged, or not of the kind that its name says (${reason})`);
  }
  if (map.width !== 2 * map.height)
    throw new Error(
      `${name}: ${map.width} × ${map.height} pixels; a map in latitude and longitude is twice as ` +
        "wide as high. Other kinds: lambent view --web ASSET cube:FILE (or angular:, ball:)",
    );
  makeRadiance(map.data);
  return map;
}

/** Negative channels become 0, NaN too, infinities the largest value there is. */
function makeRadiance(data: Float32Array): void {
  let largest = 0;
  for (const value of data) if (value > largest && value < Infinity) largest = value;
  for (let i = 0; i < data.length; ++i) {
    const value = data[i]!;
    if (!(value >= 0)) data[i] = 0;
    else if (value === Infinity) data[i] = largest;
  }
}

function decodeHdr(bytes: ArrayBuffer): LightMap {
  const { width, height, data } = new HDRLoader().setDataType(FloatType).parse(bytes) as {
    width: number;
    height: number;
    data: Float32Array;
  };
  // Radiance stores a number n of 8 bits as n/256 of its exponent; three's loader takes n/255.
  for (let i = 0; i < data.length; ++i) if (i % 4 !== 3) data[i]! *= 255 / 256;
  return { width, height, data };
}

function decodeExr(bytes: ArrayBuffer): LightMap {
  const parsed = new EXRLoader().setDataType(FloatType).parse(bytes) as {
    width: number;
    height: number;
    data: Float32Array;
    format: number;
    header: { chromaticities?: Chromaticities; envmap?: string; spec: { multiPart: boolean } };
  };
  const { width, height, header } = parsed;
  // What the loader takes for the picture then is not what the tool takes.
  if (header.envmap === "ENVMAP_CUBE" || header.spec.multiPart)
    throw new Error("a cube map or several parts: lambent view --web ASSET FILE shows it here");
  const channels = parsed.format === RedFormat ? 1 : 4;
  const data = new Float32Array(4 * width * height);
  // The loader gives the lowest row first.
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      for (let c = 0; c < 4; ++c)
        data[4 * (y * width + x) + c] =
          parsed.data[channels * ((height - 1 - y) * width + x) + (channels === 4 ? c : 0)]!;
  if (header.chromaticities && channels === 4) toRec709(header.chromaticities, data);
  return { width, height, data };
}

async function decodePicture(bytes: ArrayBuffer): Promise<LightMap> {
  const bitmap = await createImageBitmap(new Blob([bytes]), {
    colorSpaceConversion: "none",
    premultiplyAlpha: "none",
  });
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext("2d");
  if (context === null) throw new Error("the browser gives no canvas for its pixels");
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  const table = Float32Array.from({ length: 256 }, (_, i) => srgbDecode(i / 255));
  const coded = context.getImageData(0, 0, width, height).data;
  const data = Float32Array.from(coded, (value) => table[value]!);
  return { width, height, data };
}

export function asEquirectangular(map: LightMap): EquirectangularImage {
  return { ...map, channels: 4, encoding: "float32", topRowFirst: true };
}

/** The mean of whole blocks of pixels, until the map is at most `most` wide: for the GPU. */
export function reduced(map: LightMap, most: number): LightMap {
  let { width, height, data } = map;
  while (width > most && width % 2 === 0 && height % 2 === 0) {
    const [w, h] = [width / 2, height / 2];
    const half = new Float32Array(4 * w * h);
    for (let y = 0; y < h; ++y)
      for (let x = 0; x < w; ++x)
        for (let c = 0; c < 4; ++c) {
          const at = 4 * (2 * y * width + 2 * x) + c;
          half[4 * (y * w + x) + c] =
            (data[at]! + data[at + 4]! + data[at + 4 * width]! + data[at + 4 * width + 4]!) / 4;
        }
    [width, height, data] = [w, h, half];
  }
  return { width, height, data };
}

/** The map's value in a direction given by longitude u and latitude v, both 0 … 1. Nearest. */
export function pixelAt(map: LightMap, u: number, v: number): [number, number, number] {
  const x = Math.min(map.width - 1, Math.floor((u - Math.floor(u)) * map.width));
  const y = Math.min(map.height - 1, Math.max(0, Math.floor(v * map.height)));
  const at = 4 * (y * map.width + x);
  return [map.data[at]!, map.data[at + 1]!, map.data[at + 2]!];
}
