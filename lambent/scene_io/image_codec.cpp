#include "lambent/scene_io/image_codec.h"

#include <algorithm>
#include <cassert>
#include <climits>
#include <cstdlib>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wshadow"
// Static: other rooms may compile the same header with other settings.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace lambent::scene_io {

Result<scene::Texture> decodeImage(std::span<const std::byte> bytes, const std::string& place) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = int(std::min<std::size_t>(bytes.size(), INT_MAX));
  int width = 0, height = 0, channels = 0;
  if (size == 0 || !stbi_info_from_memory(data, size, &width, &height, &channels)) {
    return report::badInput(place + " is not a PNG or JPEG image; convert it to one of these");
  }
  // A header may claim any size; deflate packs at best 1032 : 1 (of 8 pixels a byte), so a file
  // this much smaller than its image is no image.
  const std::int64_t pixels = std::int64_t(width) * height;
  if (pixels > std::int64_t(1) << 28 || pixels / 8256 > size + 64) {
    return report::badInput(place + " claims " + std::to_string(width) + "×" +
                            std::to_string(height) + " pixels, which " + std::to_string(size) +
                            " bytes cannot hold or Lambent does not; make it smaller");
  }
  std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &std::free);
  if (!rgba) {
    return report::badInput(place + " is damaged (" + stbi_failure_reason() + "); export it again");
  }
  scene::Texture texture;
  texture.width = width;
  texture.height = height;
  texture.rgba.assign(rgba.get(), rgba.get() + 4 * std::size_t(width) * height);
  if (data[0] == 0x89 && size > 4 && data[1] == 'P') texture.mimeType = "image/png";
  if (data[0] == 0xff && size > 4 && data[1] == 0xd8) texture.mimeType = "image/jpeg";
  if (!texture.mimeType.empty()) texture.encoded.assign(data, data + size);
  return texture;
}

std::vector<std::uint8_t> encodePng(int width, int height, std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == 4 * std::size_t(width) * height);
  std::vector<std::uint8_t> png;
  stbi_write_png_to_func(
      [](void* context, void* data, int size) {
        const auto* first = static_cast<const std::uint8_t*>(data);
        auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
        out.insert(out.end(), first, first + size);
      },
      &png, width, height, 4, rgba.data(), 4 * width);
  return png;
}

}  // namespace lambent::scene_io
