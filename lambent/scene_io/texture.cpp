#include "lambent/scene_io/texture.h"

#include "lambent/image/decode.h"

namespace lambent::scene_io {

using image::Format;

bool isReadablePicture(std::span<const std::byte> bytes) {
  const Format format = image::formatOf(bytes);
  return format == Format::Png || format == Format::Jpeg || format == Format::WebP;
}

Result<scene::Texture> decodeTexture(std::span<const std::byte> bytes, const std::string& place,
                                     file::Budget& budget) {
  const Format format = image::formatOf(bytes);
  if (!isReadablePicture(bytes)) {
    return report::badInput(place +
                            " is not a PNG, JPEG or WebP image; convert it to one of these");
  }
  if (Status fits = budget.hold(bytes.size(), place); !fits) return fits.error();
  Result<image::Pixels8> pixels = image::decode8(bytes, place, budget);
  if (!pixels) return pixels.error();
  scene::Texture texture;
  texture.width = pixels->width;
  texture.height = pixels->height;
  texture.rgba = std::move(pixels->rgba);
  if (format == Format::Png) texture.mimeType = "image/png";
  if (format == Format::Jpeg) texture.mimeType = "image/jpeg";
  if (!texture.mimeType.empty()) {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    texture.encoded.assign(data, data + bytes.size());
  } else {
    budget.release(bytes.size());
  }
  return texture;
}

}  // namespace lambent::scene_io
