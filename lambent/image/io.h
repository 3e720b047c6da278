// Files ⇄ Image, by extension: .exr (every compression OpenEXR reads; written ZIP, half or float),
// .hdr (Radiance RGBE), .png (8 or 16 bit; colour is sRGB-encoded and becomes linear).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/report/result.h"

namespace lambent::image {

Result<Image> read(const std::filesystem::path& path);

struct WriteOptions {
  bool halfFloat = false;  ///< EXR: 16-bit channels instead of 32
  std::vector<std::pair<std::string, const Image*>>
      layers;  ///< EXR: further layers, e.g. "variance"
};
/// Atomic. PNG: values are clamped to [0, 1] and sRGB-encoded (tone-map first).
Status write(const Image& image, const std::filesystem::path& path,
             const WriteOptions& options = {});

}  // namespace lambent::image
