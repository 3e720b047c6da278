// PNG and JPEG from memory as 8-bit pixels, as textures want them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::image {

struct Pixels8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4·width·height, top row first, values as the file has them
                                   ///< (sRGB-encoded colour, straight alpha)
};

/// A whole PNG or JPEG file; 16-bit PNG loses its lower 8 bits. BadInput says what is wrong and at
/// which byte; `name` stands there for the file.
Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name = "image");

}  // namespace lambent::image
