// PNG, JPEG and WebP from memory as 8-bit pixels, as textures want them, and 8-bit pixels as PNG.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/report/result.h"

namespace lambent::image {

enum class Format { Unknown, Exr, Hdr, Png, Jpeg, WebP };

/// By the first bytes.
Format formatOf(std::span<const std::byte> bytes);

struct Pixels8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4·width·height, top row first, values as the file has them
                                   ///< (sRGB-encoded colour, straight alpha)
};

/// A whole PNG, JPEG or WebP file (not an animation); 16-bit PNG loses its lower 8 bits. BadInput
/// says what is wrong and at which byte; `name` stands there for the file. The pixels are held in
/// `budget`, 4·width·height bytes; what decoding takes besides is released.
Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name,
                        file::Budget& budget);
/// The same with the budget of a file of its own.
Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name = "image");

/// `components`: 3 or 4 samples a pixel, top row first. Throws std::bad_alloc.
std::vector<std::byte> encodePng(int width, int height, int components,
                                 std::span<const std::uint8_t> samples);

}  // namespace lambent::image
