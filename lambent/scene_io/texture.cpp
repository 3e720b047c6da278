#include "lambent/scene_io/texture.h"

#include <algorithm>

#include "lambent/image/decode.h"

namespace lambent::scene_io {

using image::Format;

bool isReadablePicture(std::span<const std::byte> bytes) {
  const Format format = image::formatOf(bytes);
  return format == Format::Png || format == Format::Jpeg || format == Format::WebP;
}

Result<scene::Texture> withAlphaOf(const scene::Texture* color, const scene::Texture& alpha,
                                   const std::string& place, file::Budget& budget) {
  scene::Texture out;
  out.name = color != nullptr ? color->name : alpha.name;
  out.wrapU = color != nullptr ? color->wrapU : alpha.wrapU;
  out.wrapV = color != nullptr ? color->wrapV : alpha.wrapV;
  out.width = std::max(alpha.width, color != nullptr ? color->width : 1);
  out.height = std::max(alpha.height, color != nullptr ? color->height : 1);
  const std::size_t texels = std::size_t(out.width) * std::size_t(out.height);
  if (Status fits = budget.hold(4 * texels, place); !fits) return fits.error();
  out.rgba.resize(4 * texels, 255);
  bool hasAlpha = false;
  for (std::size_t i = 3; i < alpha.rgba.size(); i += 4) hasAlpha |= alpha.rgba[i] < 255;
  const auto nearest = [&](const scene::Texture& from, int x, int y) {
    const auto fx = std::size_t(std::int64_t(x) * from.width / out.width);
    const auto fy = std::size_t(std::int64_t(y) * from.height / out.height);
    return from.rgba.data() + 4 * (fy * std::size_t(from.width) + fx);
  };
  std::uint8_t* to = out.rgba.data();
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x, to += 4) {
      if (color != nullptr) std::copy_n(nearest(*color, x, y), 3, to);
      const std::uint8_t* a = nearest(alpha, x, y);
      to[3] = hasAlpha ? a[3] : std::uint8_t((int(a[0]) + a[1] + a[2]) / 3);
    }
  }
  return out;
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
