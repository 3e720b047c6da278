// Every kind of PNG, JPEG and WebP, sound and damaged.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lambent/image/decode.h"
#include "lambent/image/io.h"
#include "lambent/image/test_codecs.h"
#include "lambent/image/test_pictures.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

constexpr int kAcross = 13, kDown = 11;

unsigned codeAt(const PngKind& kind, int x, int y, int c) {
  const unsigned mixed =
      7u * unsigned(x) + 13u * unsigned(y) * unsigned(c + 1) + 101u * unsigned(c);
  return (kind.depth == 16 ? mixed * 2749u : mixed) & ((1u << kind.depth) - 1);
}

unsigned bigEndian16(const std::string& text, size_t at) {
  return static_cast<unsigned char>(text[at]) << 8 | static_cast<unsigned char>(text[at + 1]);
}

/// What the specification says the pixel is: codes of 8 or 16 bits.
std::array<unsigned, 4> expectedAt(const PngKind& kind, int x, int y) {
  const unsigned largest = (1u << kind.depth) - 1, most = kind.depth == 16 ? 65535u : 255u;
  const auto code = [&](int c) { return codeAt(kind, x, y, c); };
  const auto scaled = [&](int c) { return code(c) * most / largest; };
  if (kind.type == 3) {
    const auto byte = [](const std::string& text, size_t at, unsigned otherwise) {
      return at < text.size() ? static_cast<unsigned char>(text[at]) : otherwise;
    };
    const unsigned i = code(0);
    return {byte(kind.palette, 3 * i, 0), byte(kind.palette, 3 * i + 1, 0),
            byte(kind.palette, 3 * i + 2, 0), byte(kind.transparency, i, 255)};
  }
  const bool grey = kind.type == 0 || kind.type == 4;
  std::array<unsigned, 4> p{scaled(0), scaled(grey ? 0 : 1), scaled(grey ? 0 : 2), most};
  if (kind.type == 4) p[3] = scaled(1);
  if (kind.type == 6) p[3] = scaled(3);
  if (!kind.transparency.empty()) {  // one colour is transparent
    bool same = true;
    for (int c = 0; c < (grey ? 1 : 3); ++c) {
      same = same && code(c) == bigEndian16(kind.transparency, 2 * size_t(c));
    }
    if (same) p[3] = 0;
  }
  return p;
}

std::vector<PngKind> allKinds() {
  std::vector<PngKind> kinds;
  std::string palette;
  for (int i = 0; i < 768; ++i) palette += static_cast<char>(i * 37 + 5);
  for (const bool interlaced : {false, true}) {
    for (const int depth : {1, 2, 4, 8, 16}) {
      for (const int type : {0, 2, 3, 4, 6}) {
        if (type == 3 ? depth == 16 : type != 0 && depth < 8) continue;
        PngKind kind{depth, type, interlaced, "", ""};
        if (type == 3) kind.palette = palette.substr(0, size_t(3) << depth);
        kinds.push_back(kind);
        if (type == 3) kind.transparency = std::string("\x00\x7f", 2);
        for (int c = 0; c < pngChannels(type) && (type == 0 || type == 2); ++c) {
          const unsigned code = codeAt(kind, 5, 3, c);
          kind.transparency += {static_cast<char>(code >> 8), static_cast<char>(code)};
        }
        if (!kind.transparency.empty()) kinds.push_back(kind);
      }
    }
  }
  return kinds;
}

std::string fileOf(const PngKind& kind) {
  return makePng(kAcross, kDown, kind, [&](int x, int y, int c) { return codeAt(kind, x, y, c); });
}

TEST(Codecs, EveryKindOfPng) {
  for (const PngKind& kind : allKinds()) {
    SCOPED_TRACE("depth " + std::to_string(kind.depth) + " type " + std::to_string(kind.type) +
                 (kind.interlaced ? " interlaced" : "") +
                 (kind.transparency.empty() ? "" : " with tRNS"));
    const std::string file = fileOf(kind);
    const Result<Pixels8> pixels = decode8(bytesOf(file));
    ASSERT_TRUE(pixels) << pixels.error().message;
    const Result<Image> image = decode(bytesOf(file), "a.png");
    ASSERT_TRUE(image) << image.error().message;
    const bool hasAlpha = kind.type >= 4 || !kind.transparency.empty();
    ASSERT_EQ(!image->alpha.empty(), hasAlpha);
    const float most = kind.depth == 16 ? 65535.0f : 255.0f;
    for (int y = 0; y < kDown; ++y) {
      for (int x = 0; x < kAcross; ++x) {
        const std::array<unsigned, 4> expected = expectedAt(kind, x, y);
        const size_t i = size_t(y) * kAcross + x;
        const float alpha = static_cast<float>(expected[3]) / most;
        if (hasAlpha) {
          ASSERT_FLOAT_EQ(image->alpha[i], alpha);
        }
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(pixels->rgba[4 * i + c], kind.depth == 16 ? expected[c] >> 8 : expected[c])
              << x << " " << y << " " << c;
        }
        for (int c = 0; c < 3; ++c) {
          ASSERT_FLOAT_EQ(image->pixels[i][c],
                          radiometry::srgbDecode(static_cast<float>(expected[c]) / most) * alpha);
        }
      }
    }
  }
}

int smooth(int x, int y, int c) {
  return 40 + 4 * x + 3 * y + 20 * c;
}

TEST(Codecs, EveryKindOfJpeg) {
  for (const bool progressive : {false, true}) {
    for (const int components : {1, 3, 4}) {
      SCOPED_TRACE(std::to_string(components) + (progressive ? " progressive" : ""));
      const std::string file = makeJpeg(24, 17, {components, progressive}, smooth);
      const Result<Pixels8> pixels = decode8(bytesOf(file));
      ASSERT_TRUE(pixels) << pixels.error().message;
      ASSERT_EQ(pixels->width, 24);
      ASSERT_EQ(pixels->height, 17);
      for (int y = 0; y < 17; ++y) {
        for (int x = 0; x < 24; ++x) {
          const std::uint8_t* const p = &pixels->rgba[4 * (size_t(y) * 24 + x)];
          for (int c = 0; c < 3; ++c) {
            double expected = smooth(x, y, components == 1 ? 0 : c);
            // Adobe's ink is written as 255 − ink, so that paper white is 255.
            if (components == 4) expected *= smooth(x, y, 3) / 255.0;
            ASSERT_NEAR(p[c], expected, 6.0) << x << " " << y << " " << c;
          }
          ASSERT_EQ(p[3], 255);
        }
      }
      const Result<Image> image = decode(bytesOf(file), "a.jpg");
      ASSERT_TRUE(image);
      EXPECT_TRUE(image->alpha.empty());
    }
  }
}

TEST(Codecs, WebP) {
  std::vector<std::uint8_t> rgba(4 * 24 * 17);
  Sequence sequence(3);
  for (std::uint8_t& code : rgba) code = static_cast<std::uint8_t>(sequence.bits());
  for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] |= 1;  // the encoder drops what is not seen
  const std::string file = makeWebP(24, 17, rgba);
  const Result<Pixels8> pixels = decode8(bytesOf(file));
  ASSERT_TRUE(pixels) << pixels.error().message;
  EXPECT_EQ(pixels->rgba, rgba);
  const Result<Image> image = decode(bytesOf(file), "a.webp");
  ASSERT_TRUE(image);
  EXPECT_FLOAT_EQ(image->alpha[5], static_cast<float>(rgba[23]) / 255.0f);
  EXPECT_FLOAT_EQ(image->pixels[5][1],
                  radiometry::srgbDecode(static_cast<float>(rgba[21]) / 255.0f) * image->alpha[5]);
  for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
  const std::string opaque = makeWebP(24, 17, rgba);
  EXPECT_TRUE(decode(bytesOf(opaque), "a.webp")->alpha.empty());
}

TEST(Codecs, FormatsAreKnownByTheirFirstBytes) {
  EXPECT_EQ(formatOf(bytesOf(fileOf({}))), Format::Png);
  EXPECT_EQ(formatOf(bytesOf(makeJpeg(8, 8, {}, smooth))), Format::Jpeg);
  EXPECT_EQ(formatOf(bytesOf(makeWebP(1, 1, {1, 2, 3, 4}))), Format::WebP);
  EXPECT_EQ(formatOf(bytesOf("#?RADIANCE\n")), Format::Hdr);
  EXPECT_EQ(formatOf(bytesOf("\x76\x2f\x31\x01")), Format::Exr);
  EXPECT_EQ(formatOf(bytesOf("BM or something")), Format::Unknown);
  EXPECT_EQ(formatOf({}), Format::Unknown);
  EXPECT_EQ(decode8(bytesOf("BM or something"), "a.bmp").error().kind, ErrorKind::BadInput);
}

void expectDamaged(const std::string& file, const std::string& words) {
  for (const bool asTexture : {true, false}) {
    std::string message;
    if (asTexture) {
      const Result<Pixels8> pixels = decode8(bytesOf(file), "the name");
      ASSERT_FALSE(pixels) << words;
      EXPECT_EQ(pixels.error().kind, ErrorKind::BadInput);
      message = pixels.error().message;
    } else {
      const Result<Image> image = decode(bytesOf(file), "the name");
      ASSERT_FALSE(image) << words;
      message = image.error().message;
    }
    EXPECT_TRUE(message.starts_with("the name: ")) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks: " << words;
  }
}

TEST(Codecs, DamageIsPlaced) {
  const std::string sound = fileOf({});
  std::string file = sound;
  file[sound.find("IDAT") + 20] ^= 1;
  expectDamaged(
      file, "the checksum of a chunk is wrong at byte " + std::to_string(sound.find("IDAT") - 4));
  // Deflated data that end too early, in a chunk that is sound.
  const size_t data = sound.find("IDAT") - 4;
  file =
      sound.substr(0, data) + pngChunk("IDAT", sound.substr(data + 8, 60)) + pngChunk("IEND", "");
  expectDamaged(file, "cannot be decoded");
  file = sound.substr(0, data) + pngChunk("IDAT", std::string(40, '\x55')) + pngChunk("IEND", "");
  expectDamaged(file, "at byte " + std::to_string(data));

  for (const bool progressive : {false, true}) {
    const std::string jpeg = makeJpeg(64, 64, {3, progressive}, [](int x, int y, int c) {
      return (x * x + 3 * y * (c + 1) + 31 * c) % 256;
    });
    expectDamaged(jpeg.substr(0, jpeg.size() / 2), "at byte " + std::to_string(jpeg.size() / 2));
    expectDamaged(jpeg.substr(0, jpeg.size() - 2), "at byte ");  // the end marker alone is missing
    std::string counts = jpeg;
    counts[counts.find("\xff\xc4") + 5] = '\xff';  // 255 codes of one bit
    expectDamaged(counts, "Bogus Huffman table");
  }
  const std::string webp = makeWebP(8, 8, std::vector<std::uint8_t>(256, 77));
  expectDamaged(webp.substr(0, webp.size() - 3), "ends at byte " + std::to_string(webp.size() - 3));
}

TEST(Codecs, AnyBytesAreAnsweredWithPixelsOrBadInput) {
  std::vector<std::uint8_t> rgba(4 * 24 * 17);
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i * i / 7);
  for (const std::string& sound :
       {fileOf({4, 3, true, std::string(48, 'a'), "b"}), makeJpeg(24, 17, {3, false}, smooth),
        makeJpeg(24, 17, {4, true}, smooth), makeWebP(24, 17, rgba)}) {
    ASSERT_TRUE(decode8(bytesOf(sound)));
    Sequence sequence(sound.size());
    for (int trial = 0; trial < 1500; ++trial) {
      std::string file = sound;
      if (trial < 500) {
        file.resize(sequence.bits() % sound.size());
      } else {
        for (unsigned n = 1 + sequence.bits() % 4; n > 0; --n) {
          file[sequence.bits() % file.size()] = static_cast<char>(sequence.bits());
        }
      }
      const Result<Pixels8> pixels = decode8(bytesOf(file), "the name");
      if (pixels) {
        ASSERT_EQ(pixels->rgba.size(), 4 * size_t(pixels->width) * pixels->height);
      } else {
        ASSERT_EQ(pixels.error().kind, ErrorKind::BadInput);
        ASSERT_TRUE(pixels.error().message.starts_with("the name"));
      }
      if (trial < 500) {
        ASSERT_FALSE(pixels) << file.size();
      }
    }
  }
}

TEST(Codecs, ABudgetIsKept) {
  const std::string file = fileOf({});
  file::Budget budget(std::uint64_t(4 * kAcross * kDown));
  EXPECT_TRUE(decode8(bytesOf(file), "a.png", budget));
  const Result<Pixels8> second = decode8(bytesOf(file), "b.png", budget);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("b.png: a picture of 13×11 pixels would take 572 bytes"),
            std::string::npos)
      << second.error().message;
  EXPECT_FALSE(decode(bytesOf(file), "a.png", {.memoryLimit = 1000}));
  EXPECT_TRUE(decode(bytesOf(file), "a.png", {.memoryLimit = 10000}));
}

TEST(Codecs, EncodedPngComesBack) {
  std::vector<std::uint8_t> rgba(4 * 5 * 3);
  for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i * 41);
  const Result<Pixels8> back = decode8(encodePng(5, 3, 4, rgba));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rgba, rgba);
}

}  // namespace
}  // namespace lambent::image
