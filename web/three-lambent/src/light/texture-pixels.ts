// The pixels of a three texture that lie in memory.

import { FloatType, HalfFloatType, SRGBColorSpace, UnsignedByteType, type Texture } from "three";
import type { EquirectangularImage } from "./equirectangular.js";

/** @throws Error if the texture's pixels are not in memory, or of a kind that is no radiance. */
export function imageOfTexture(texture: Texture): EquirectangularImage {
  const image = texture.image as {
    data?: ArrayLike<number> | null;
    width?: number;
    height?: number;
  } | null;
  const { data, width, height } = image ?? {};
  if (!data || !width || !height)
    throw new Error(
      "LambentLight: the texture's pixels are not in memory: give a DataTexture (as HDRLoader and " +
        "EXRLoader make them), or the pixels themselves",
    );
  const channels = data.length / (width * height);
  if (channels !== 3 && channels !== 4)
    throw new Error(`LambentLight: ${channels} numbers a pixel, where 3 or 4 can be`);
  // A texture without flipY has its first row at v = 0, which three looks up straight down.
  const common = { data, width, height, channels, topRowFirst: texture.flipY } as const;
  if (texture.type === FloatType) return { ...common, encoding: "float32" };
  if (texture.type === HalfFloatType) return { ...common, encoding: "float16" };
  if (texture.type === UnsignedByteType && texture.colorSpace === SRGBColorSpace)
    return { ...common, encoding: "srgb8" };
  throw new Error(
    "LambentLight: the texture must hold floats, half floats, or bytes marked as sRGB",
  );
}
