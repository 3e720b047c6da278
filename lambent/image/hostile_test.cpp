// Damaged files: whatever their bytes, the readers answer with a picture or with BadInput.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "lambent/file/atomic_file.h"
#include "lambent/image/decode.h"
#include "lambent/image/io.h"
#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

using Bytes = std::vector<std::byte>;

class HostileFiles : public FolderTest {
 protected:
  Bytes fileOf(const Image& image, const char* name, const WriteOptions& options = {}) {
    EXPECT_TRUE(write(image, folder_ / name, options));
    Result<Bytes> bytes = file::readWhole(folder_ / name);
    EXPECT_TRUE(bytes);
    return bytes ? std::move(*bytes) : Bytes();
  }
  std::array<Bytes, 4> examples() {
    Image image = noise(40, 33, 4.0f);
    for (int x = 0; x < 40; ++x) image.at(x, 5) = Rgb(1, 1, 1);
    Image covered = image;
    covered.alpha.assign(image.pixels.size(), 0.5f);
    return {fileOf(image, "a.exr"), fileOf(covered, "b.exr", {.halfFloat = true, .layers = {}}),
            fileOf(image, "a.hdr"), fileOf(covered, "a.png")};
  }
};

void expectAnswer(const Result<Image>& result) {
  if (result) {
    EXPECT_EQ(result->pixels.size(), size_t(result->width) * result->height);
  } else {
    EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
    EXPECT_TRUE(result.error().message.starts_with("the name")) << result.error().message;
  }
}

TEST_F(HostileFiles, CutOffAnywhere) {
  for (const Bytes& whole : examples()) {
    ASSERT_TRUE(decode(whole, "the name"));
    const size_t step = std::max<size_t>(1, whole.size() / 400);
    for (size_t length = 0; length < whole.size();
         length += (length < 400 || length + 64 > whole.size()) ? 1 : step) {
      const Result<Image> result = decode(std::span(whole).first(length), "the name");
      EXPECT_FALSE(result) << length << " of " << whole.size();
      expectAnswer(result);
    }
  }
}

TEST_F(HostileFiles, BytesChanged) {
  for (const Bytes& whole : examples()) {
    Sequence sequence(whole.size());
    for (int trial = 0; trial < 600; ++trial) {
      Bytes bytes = whole;
      const int changes = 1 + static_cast<int>(sequence.bits() % 4);
      for (int i = 0; i < changes; ++i) {
        // Two of three in the first 400 bytes, where the headers are.
        const size_t range =
            sequence.bits() % 3 ? std::min<size_t>(400, bytes.size()) : bytes.size();
        bytes[sequence.bits() % range] =
            static_cast<std::byte>(sequence.bits() % 4 == 0   ? 0xff
                                   : sequence.bits() % 4 == 0 ? 0
                                                              : sequence.bits());
      }
      expectAnswer(decode(bytes, "the name"));
    }
  }
}

TEST_F(HostileFiles, HugeSizesAreRefusedBeforeMemoryIsTaken) {
  const auto hdr = [](const std::string& resolution) {
    const std::string file =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + std::string(64, 'x');
    const auto bytes = std::as_bytes(std::span(file));
    return decode(bytes, "the name");
  };
  for (const char* resolution :
       {"-Y 100000 +X 100000", "-Y 2147483647 +X 2147483647", "-Y 99999999999 +X 8", "-Y 0 +X 8",
        "-Y -5 +X 8", "-Y 16384 +X 16384", "-Y 8 +Y 8", "Y 8 X 8", ""}) {
    const Result<Image> result = hdr(resolution);
    EXPECT_FALSE(result) << resolution;
    expectAnswer(result);
  }

  Bytes exr = fileOf(noise(8, 8), "a.exr");
  const std::string_view key = "dataWindow";
  const std::string_view text(reinterpret_cast<const char*>(exr.data()), exr.size());
  const size_t at = text.find(key) + key.size() + 1 + 6 + 4;  // name, "box2i", size
  const std::array<std::int32_t, 4> huge{0, 0, 1 << 29, 1 << 29};
  std::memcpy(exr.data() + at, huge.data(), sizeof(huge));
  const Result<Image> result = decode(exr, "the name");
  EXPECT_FALSE(result);
  expectAnswer(result);
}

TEST_F(HostileFiles, ExrAttributesTakeWhatTheirSizeSays) {
  const Bytes whole = fileOf(noise(8, 8), "a.exr");
  for (const std::string_view type : {"chlist", "box2i", "float"}) {
    Bytes exr = whole;
    const std::string_view text(reinterpret_cast<const char*>(exr.data()), exr.size());
    const size_t size = text.find(type) + type.size() + 1;
    exr[size] = static_cast<std::byte>(std::to_integer<int>(exr[size]) + 1);
    const Result<Image> result = decode(exr, "the name");
    ASSERT_FALSE(result) << type;
    EXPECT_NE(result.error().message.find("does not fit its size"), std::string::npos)
        << result.error().message;
  }
}

TEST_F(HostileFiles, Jpeg) {
  // The smallest grey baseline JPEG: one 8×8 block, written out by hand.
  std::vector<unsigned char> jpeg{0xff, 0xd8, 0xff, 0xdb, 0, 67, 0};
  jpeg.insert(jpeg.end(), 64, 1);  // quantisation: all 1
  jpeg.insert(jpeg.end(), {0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});  // 8×8, one component
  for (const unsigned char table : {0x00, 0x10}) {  // one code of length 1 for the symbol 0
    jpeg.insert(jpeg.end(), {0xff, 0xc4, 0, 20, table, 1});
    jpeg.insert(jpeg.end(), 15, 0);
    jpeg.push_back(0);
  }
  jpeg.insert(jpeg.end(), {0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0, 0x3f, 0xff, 0xd9});
  const auto bytes = std::as_bytes(std::span(jpeg));
  const Result<Pixels8> pixels = decode8(bytes, "the name");
  ASSERT_TRUE(pixels) << pixels.error().message;
  EXPECT_EQ(pixels->width, 8);
  EXPECT_EQ(pixels->rgba[0], 128);
  EXPECT_EQ(pixels->rgba[3], 255);
  const Result<Image> image = decode(bytes, "the name");
  ASSERT_TRUE(image);
  EXPECT_TRUE(image->alpha.empty());
  for (size_t length = 0; length < jpeg.size(); ++length) {
    EXPECT_FALSE(decode(bytes.first(length), "the name")) << length;
  }
  Sequence sequence(5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<unsigned char> damaged = jpeg;
    damaged[sequence.bits() % damaged.size()] = static_cast<unsigned char>(sequence.bits());
    expectAnswer(decode(std::as_bytes(std::span(damaged)), "the name"));
  }
}

TEST_F(HostileFiles, DamagedPngChunkIsPlaced) {
  Bytes png = fileOf(noise(16, 16), "a.png");
  png[60] ^= std::byte{1};
  const Result<Image> result = decode(png, "the name");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("checksum of a chunk is wrong at byte 33"),
            std::string::npos)
      << result.error().message;
}

}  // namespace
}  // namespace lambent::image
