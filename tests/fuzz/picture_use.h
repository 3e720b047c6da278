// What becomes of a picture once it is read.
#pragma once

#include <optional>
#include <string_view>

#include "lambent/image/decode.h"
#include "lambent/image/image.h"
#include "tests/fuzz/target.h"

namespace lambent::fuzz {

/// The picture, if `bytes` are one of this format that can be read.
std::optional<image::Image> pictureIn(Bytes bytes, image::Format format);

/// As an environment is made of it: repaired, projected, looked up and sampled. Small ones only.
void useAsLight(image::Image picture);

/// Written under `name` and read again.
image::Image writtenAndRead(const image::Image& picture, std::string_view name);

/// Bit for bit, NaN too.
bool same(const image::Image& a, const image::Image& b);

/// As a texture: the eight bits of PNG, JPEG and WebP. `readable`: whether it was as a picture.
void useAsTexture(Bytes bytes, bool readable);

}  // namespace lambent::fuzz
