// PNG and JPEG in memory ⇄ 8-bit RGBA texels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// Decodes PNG, JPEG (kept in `encoded` too), BMP or TGA. `place` begins the error's message.
Result<scene::Texture> decodeImage(std::span<const std::byte> bytes, const std::string& place);

std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace lambent::scene_io
