// PNG and JPEG by stb_image and stb_image_write, compiled here, once and with internal linkage, so
// that nobody's copy of stb meets ours at link time. stb checks neither a PNG's checksums nor that
// a JPEG is whole, so that is done here, before it sees the bytes.
#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstring>
#include <memory>

#include "lambent/image/decode.h"
#include "lambent/image/formats.h"
#include "lambent/radiometry/srgb.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS (1 << 20)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace lambent::image {
namespace formats {
namespace {

// Deflate makes at most 1032 bytes of one, eight 1-bit pixels each; a progressive JPEG scan skips
// 32767 blocks of 64 pixels in three bytes, but its first scan spends a bit on every block.
constexpr size_t kMaxPixelsPerByte = 16384;

constexpr std::array<unsigned char, 8> kPngMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

Error damaged(std::string_view name, const std::string& what, size_t at) {
  return report::badInput(std::string(name) + ": " + what + " at byte " + std::to_string(at) +
                          "; the file is damaged or cut off");
}

std::uint32_t bigEndian(Bytes bytes, size_t at) {
  std::uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

/// The checksum of PNG's specification, annex D (that of ISO 3309).
std::uint32_t checksum(Bytes bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[n] = c;
    }
    return t;
  }();
  std::uint32_t c = 0xffffffffu;
  for (const std::byte b : bytes)
    c = table[(c ^ std::to_integer<std::uint32_t>(b)) & 255] ^ (c >> 8);
  return ~c;
}

Status checkPng(Bytes bytes, std::string_view name) {
  size_t at = kPngMagic.size();
  for (bool first = true;; first = false) {
    if (bytes.size() - at < 12) return damaged(name, "a chunk is missing", at);
    const size_t length = bigEndian(bytes, at);
    const std::string type(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4);
    if (length > bytes.size() - at - 12)
      return damaged(name, "a chunk is longer than the file", at);
    if (bigEndian(bytes, at + 8 + length) != checksum(bytes.subspan(at + 4, length + 4))) {
      return damaged(name, "the checksum of a chunk is wrong", at);
    }
    if (first) {
      if (type != "IHDR" || length != 13) return damaged(name, "the header is missing", at);
      if (Status sane = checkSize(bigEndian(bytes, at + 8), bigEndian(bytes, at + 12), bytes.size(),
                                  name, kMaxPixelsPerByte);
          !sane) {
        return sane;
      }
    }
    if (type == "IEND") return Status::ok();
    at += 12 + length;
  }
}

/// Walks the segments up to the first scan, and asks for an end marker behind it: stb fills what is
/// missing with grey and says nothing.
Status checkJpeg(Bytes bytes, std::string_view name) {
  size_t at = 2;
  bool sized = false;
  for (;;) {
    if (bytes.size() - at < 4) return damaged(name, "a segment is missing", at);
    if (bytes[at] != std::byte{0xff}) return damaged(name, "no segment begins", at);
    const unsigned marker = std::to_integer<unsigned>(bytes[at + 1]);
    if (marker == 0xff) {  // a fill byte
      ++at;
      continue;
    }
    const size_t length = bigEndian(bytes, at) & 0xffff;
    if (length < 2 || length > bytes.size() - at - 2) {
      return damaged(name, "a segment is longer than the file", at);
    }
    const bool startOfFrame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (startOfFrame && length >= 8) {
      const std::uint32_t size = bigEndian(bytes, at + 5);
      if (Status sane = checkSize(size & 0xffff, size >> 16, bytes.size(), name, kMaxPixelsPerByte);
          !sane)
        return sane;
      sized = true;
    }
    at += 2 + length;
    if (marker == 0xda) break;  // start of scan
  }
  if (!sized) return damaged(name, "the size of the picture is missing", at);
  for (size_t i = bytes.size() - 1; i > at; --i) {
    if (bytes[i] == std::byte{0xd9} && bytes[i - 1] == std::byte{0xff}) return Status::ok();
  }
  return damaged(name, "the end marker is missing", bytes.size());
}

Status check(Bytes bytes, std::string_view name) {
  if (bytes.size() > INT_MAX) {
    return report::badInput(std::string(name) + ": is too large; split the picture");
  }
  if (isPng(bytes)) return checkPng(bytes, name);
  if (isJpeg(bytes)) return checkJpeg(bytes, name);
  return report::badInput(std::string(name) + ": is neither PNG nor JPEG, by its first bytes");
}

struct FreeStb {
  void operator()(void* p) const { stbi_image_free(p); }
};

Error undecodable(std::string_view name) {
  const char* const reason = stbi_failure_reason();
  return report::badInput(std::string(name) + ": cannot be decoded: " +
                          (reason ? reason : "no reason given") + "; the file is damaged");
}

const stbi_uc* dataOf(Bytes bytes) {
  return reinterpret_cast<const stbi_uc*>(bytes.data());
}

template <class Sample>
Image toImage(const Sample* rgba, int width, int height, bool hasAlpha) {
  constexpr int kLargest = std::numeric_limits<Sample>::max();
  std::vector<float> linear(size_t(kLargest) + 1);
  for (int i = 0; i <= kLargest; ++i) {
    linear[i] = radiometry::srgbDecode(static_cast<float>(i) / kLargest);
  }
  Image image(width, height);
  if (hasAlpha) image.alpha.resize(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float alpha = hasAlpha ? static_cast<float>(rgba[4 * i + 3]) / kLargest : 1.0f;
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = linear[rgba[4 * i + c]] * alpha;
    if (hasAlpha) image.alpha[i] = alpha;
  }
  return image;
}

std::uint8_t encode8(float linear) {
  if (!(linear > 0.0f)) return 0;  // NaN too
  return static_cast<std::uint8_t>(
      std::lround(255.0f * radiometry::srgbEncode(std::min(linear, 1.0f))));
}

}  // namespace

bool isPng(Bytes bytes) {
  return bytes.size() >= 8 && std::memcmp(bytes.data(), kPngMagic.data(), 8) == 0;
}

bool isJpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{0xff} && bytes[1] == std::byte{0xd8} &&
         bytes[2] == std::byte{0xff};
}

Result<Image> readPngOrJpeg(Bytes bytes, std::string_view name) {
  if (Status whole = check(bytes, name); !whole) return whole.error();
  const int length = static_cast<int>(bytes.size());
  int width = 0, height = 0, components = 0;
  if (stbi_is_16_bit_from_memory(dataOf(bytes), length)) {
    const std::unique_ptr<stbi_us, FreeStb> pixels(
        stbi_load_16_from_memory(dataOf(bytes), length, &width, &height, &components, 4));
    if (!pixels) return undecodable(name);
    return toImage(pixels.get(), width, height, components == 2 || components == 4);
  }
  const std::unique_ptr<stbi_uc, FreeStb> pixels(
      stbi_load_from_memory(dataOf(bytes), length, &width, &height, &components, 4));
  if (!pixels) return undecodable(name);
  return toImage(pixels.get(), width, height, components == 2 || components == 4);
}

Result<std::vector<std::byte>> writePng(const Image& image, std::string_view name) {
  const int components = image.alpha.empty() ? 3 : 4;
  if (image.pixels.size() * components > INT_MAX / 2) {
    return report::badUsage(std::string(name) + ": too many pixels for PNG; write .exr");
  }
  std::vector<std::uint8_t> samples(image.pixels.size() * components);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    // PNG keeps colour apart from coverage.
    const float alpha = image.alpha.empty() ? 1.0f : std::clamp(image.alpha[i], 0.0f, 1.0f);
    const float divisor = alpha > 0.0f ? alpha : 1.0f;
    for (int c = 0; c < 3; ++c) {
      samples[components * i + c] = encode8(image.pixels[i][c] / divisor);
    }
    if (components == 4) {
      samples[components * i + 3] = static_cast<std::uint8_t>(std::lround(255.0f * alpha));
    }
  }
  std::vector<std::byte> out;
  const auto append = [](void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(context);
    const auto* const from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  };
  if (!stbi_write_png_to_func(append, &out, image.width, image.height, components, samples.data(),
                              image.width * components)) {
    return report::failed(std::string(name) + ": not enough memory to write the picture as PNG");
  }
  return out;
}

}  // namespace formats

Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name) {
  if (Status whole = formats::check(bytes, name); !whole) return whole.error();
  Pixels8 result;
  int components = 0;
  const std::unique_ptr<stbi_uc, formats::FreeStb> pixels(
      stbi_load_from_memory(formats::dataOf(bytes), static_cast<int>(bytes.size()), &result.width,
                            &result.height, &components, 4));
  if (!pixels) return formats::undecodable(name);
  result.rgba.assign(pixels.get(), pixels.get() + 4 * size_t(result.width) * result.height);
  return result;
}

}  // namespace lambent::image
