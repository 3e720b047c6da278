// PNG: read by libspng, written by stb_image_write, which is compiled here, once and with internal
// linkage, so that nobody's copy of stb meets ours at link time.
//
// Of a file's chunks libspng sees those that make the pixels alone. All chunks are walked before,
// so that their checksums are right up to the end and a message can say where they are not, and what
// they say of colour is noted; text, profiles and what else may be packed in a file is not unpacked.
#include <spng.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "lambent/image/decode.h"
#include "lambent/image/formats.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

/// Memory of one picture that stb_image_write packs: it does not look whether it got what it asked
/// for. So what it holds is noted here, and std::bad_alloc can pass through it.
class StbMemory {
 public:
  StbMemory() { current = this; }
  ~StbMemory() {
    current = nullptr;
    while (first_) release(first_ + 1);
  }
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;

  void* resize(void* old, size_t size) {
    Block* const before = old ? static_cast<Block*>(old) - 1 : nullptr;
    auto* const block = static_cast<Block*>(std::realloc(before, sizeof(Block) + size));
    if (!block) throw std::bad_alloc();  // the old one stays noted
    if (!old) block->previous = nullptr, block->next = first_;
    (block->previous ? block->previous->next : first_) = block;
    if (block->next) block->next->previous = block;
    return block + 1;
  }
  void release(void* memory) {
    if (!memory) return;
    Block* const block = static_cast<Block*>(memory) - 1;
    (block->previous ? block->previous->next : first_) = block->next;
    if (block->next) block->next->previous = block->previous;
    std::free(block);
  }

  static thread_local StbMemory* current;  ///< by necessity: stb hands no context on

 private:
  struct alignas(std::max_align_t) Block {
    Block *previous, *next;
  };
  Block* first_ = nullptr;
};
thread_local StbMemory* StbMemory::current = nullptr;

}  // namespace
}  // namespace lambent::image

#define STBIW_MALLOC(size) lambent::image::StbMemory::current->resize(nullptr, size)
#define STBIW_REALLOC(old, size) lambent::image::StbMemory::current->resize(old, size)
#define STBIW_FREE(memory) lambent::image::StbMemory::current->release(memory)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace lambent::image {
namespace formats {
namespace {

// Deflate makes at most 1032 bytes of one, eight 1-bit pixels each.
constexpr size_t kMaxPixelsPerPngByte = 8256;

constexpr std::array<unsigned char, 8> kPngMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

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

/// The stretches of the file that hold the pixels, and how many bytes of them were read.
struct Pieces {
  std::vector<Bytes> spans;
  bool transparency = false;  ///< a tRNS chunk is among them
  bool srgb = false;          ///< an sRGB chunk is: it outranks what `colour` says
  CodedColour colour;
  size_t span = 0, at = 0;
};

/// What an ancillary chunk says of colour. Chunks of other lengths than the specification's say
/// nothing.
void noteColour(const std::string& type, Bytes data, Pieces& pieces) {
  const auto fraction = [&](size_t i) { return bigEndian(data, 4 * i) / 100000.0; };
  if (type == "sRGB") pieces.srgb = true;
  if (type == "gAMA" && data.size() == 4 && bigEndian(data, 0) > 0) {
    // Files that want sRGB, and say it as well as a power can, are to be within 5% of this.
    constexpr double kSrgb = 0.45455;
    if (std::abs(fraction(0) / kSrgb - 1) > 0.05) pieces.colour.gamma = fraction(0);
  }
  if (type == "cHRM" && data.size() == 32)
    pieces.colour.primaries = {{fraction(2), fraction(3)},
                               {fraction(4), fraction(5)},
                               {fraction(6), fraction(7)},
                               {fraction(0), fraction(1)}};
  if (type == "iCCP") {
    const auto* const first = reinterpret_cast<const char*>(data.data());
    pieces.colour.profile = std::string(first, strnlen(first, std::min<size_t>(data.size(), 79)));
  }
}

Result<Pieces> checkPng(Bytes bytes, std::string_view name) {
  size_t at = kPngMagic.size();
  Pieces pieces;
  pieces.spans.push_back(bytes.first(at));
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
                                  name, kMaxPixelsPerPngByte);
          !sane) {
        return sane.error();
      }
    }
    for (const char* wanted : {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"}) {
      if (type == wanted) pieces.spans.push_back(bytes.subspan(at, 12 + length));
    }
    pieces.transparency = pieces.transparency || type == "tRNS";
    noteColour(type, bytes.subspan(at + 8, length), pieces);
    if (type == "IEND") {
      // The specification's order of rank: a profile, sRGB, the others.
      if (pieces.srgb || pieces.colour.profile)
        pieces.colour.gamma.reset(), pieces.colour.primaries.reset();
      return pieces;
    }
    at += 12 + length;
  }
}

int readPieces(spng_ctx*, void* user, void* to, size_t count) {
  Pieces& pieces = *static_cast<Pieces*>(user);
  auto* out = static_cast<std::byte*>(to);
  while (count > 0) {
    if (pieces.span == pieces.spans.size()) return SPNG_IO_EOF;
    const Bytes rest = pieces.spans[pieces.span].subspan(pieces.at);
    const size_t step = std::min(count, rest.size());
    if (step > 0) std::memcpy(out, rest.data(), step);
    out += step;
    count -= step;
    pieces.at += step;
    if (step == rest.size()) ++pieces.span, pieces.at = 0;
  }
  return 0;
}

/// Where the chunk begins that was being read.
size_t placeIn(const Pieces& pieces, Bytes bytes) {
  const Bytes& piece = pieces.spans[std::min(pieces.span, pieces.spans.size() - 1)];
  return static_cast<size_t>(piece.data() - bytes.data());
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

Result<Codes> readPng(Bytes bytes, std::string_view name, Depth depth, file::Budget& budget) {
  Result<Pieces> pieces = checkPng(bytes, name);
  if (!pieces) return pieces.error();
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), &spng_ctx_free);
  if (!context) throw std::bad_alloc();
  const auto undecodable = [&](int code) {
    if (code == SPNG_EMEM) throw std::bad_alloc();
    return damaged(name, std::string("cannot be decoded: ") + spng_strerror(code) + " in the chunk",
                   placeIn(*pieces, bytes));
  };
  spng_ihdr header{};
  if (int code = spng_set_png_stream(context.get(), readPieces, &*pieces)) return undecodable(code);
  if (int code = spng_get_ihdr(context.get(), &header)) return undecodable(code);

  const bool wide = depth == Depth::AsStored && header.bit_depth == 16;
  if (Status fits = holdPixels(header.width, header.height, wide ? 8 : 4, name, budget); !fits) {
    return fits.error();
  }
  Codes codes;
  codes.colour = pieces->colour;
  codes.width = static_cast<int>(header.width);
  codes.height = static_cast<int>(header.height);
  codes.hasAlpha = pieces->transparency || header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                   header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  const size_t count = 4 * size_t(header.width) * header.height;
  if (wide) {
    codes.rgba16.resize(count);
  } else {
    codes.rgba8.resize(count);
  }
  void* const out = wide ? static_cast<void*>(codes.rgba16.data()) : codes.rgba8.data();
  const int format = wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
  if (int code =
          spng_decode_image(context.get(), out, count * (wide ? 2 : 1), format, SPNG_DECODE_TRNS)) {
    return undecodable(code);
  }
  return codes;
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
  return encodePng(image.width, image.height, components, samples);
}

}  // namespace formats

std::vector<std::byte> encodePng(int width, int height, int components,
                                 std::span<const std::uint8_t> samples) {
  assert(samples.size() == size_t(components) * width * height);
  std::vector<std::byte> out;
  const auto append = [](void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(context);
    const auto* const from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  };
  StbMemory memory;
  if (!stbi_write_png_to_func(append, &out, width, height, components, samples.data(),
                              width * components)) {
    throw std::bad_alloc();
  }
  return out;
}

}  // namespace lambent::image
