// WebP by libwebp: one picture, with loss or without. Animations are not read.
#include <webp/decode.h>

#include <cstring>

#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

const char* reasonOf(VP8StatusCode code) {
  switch (code) {
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED:
      return "the data end too early";
    case VP8_STATUS_BITSTREAM_ERROR:
      return "the data make no sense";
    case VP8_STATUS_UNSUPPORTED_FEATURE:
      return "it uses something that is not supported";
    default:
      return "its header makes no sense";
  }
}

}  // namespace

bool isWebP(Bytes bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

Result<Codes> readWebP(Bytes bytes, std::string_view name, file::Budget& budget) {
  size_t length = 8;
  for (size_t i = 0; i < 4; ++i) length += std::to_integer<size_t>(bytes[4 + i]) << (8 * i);
  if (length > bytes.size()) {
    return damaged(name, "its header says " + std::to_string(length) + " bytes, but the file ends",
                   bytes.size());
  }
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const auto undecodable = [&](VP8StatusCode code) {
    if (code == VP8_STATUS_OUT_OF_MEMORY) throw std::bad_alloc();
    // libwebp does not say where.
    return report::badInput(std::string(name) + ": cannot be decoded as WebP: " + reasonOf(code) +
                            ", somewhere in " + std::to_string(bytes.size()) +
                            " bytes; the file is damaged or cut off");
  };
  WebPDecoderConfig config;
  if (!WebPInitDecoderConfig(&config)) return report::failed("libwebp is of another version");
  if (const VP8StatusCode code = WebPGetFeatures(data, bytes.size(), &config.input)) {
    return undecodable(code);
  }
  if (config.input.has_animation) {
    return report::badInput(std::string(name) +
                            ": is an animation; save one picture of it, or convert it to PNG");
  }
  const int width = config.input.width, height = config.input.height;
  // A picture of one colour takes a few bytes, whatever its size: the budget bounds it.
  if (Status sane = checkSize(width, height, bytes.size(), name, kMaxPixels); !sane) {
    return sane.error();
  }
  // Lossless pictures are decoded into four bytes a pixel of the library's own before they are
  // ours.
  if (Status fits = holdPixels(width, height, 8, name, budget); !fits) return fits.error();
  Codes codes;
  codes.width = width;
  codes.height = height;
  codes.hasAlpha = config.input.has_alpha != 0;
  codes.rgba8.resize(4 * size_t(width) * height);
  config.output.colorspace = MODE_RGBA;
  config.output.is_external_memory = 1;
  config.output.u.RGBA = {codes.rgba8.data(), 4 * width, codes.rgba8.size()};
  const VP8StatusCode code = WebPDecode(data, bytes.size(), &config);
  WebPFreeDecBuffer(&config.output);
  if (code != VP8_STATUS_OK) return undecodable(code);
  budget.release(4 * size_t(width) * height);
  return codes;
}

}  // namespace lambent::image::formats
