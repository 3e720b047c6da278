#include "lambent/image/io.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "lambent/file/atomic_file.h"
#include "lambent/image/decode.h"
#include "lambent/image/repair.h"
#include "lambent/image/test_pictures.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

class ImageIo : public FolderTest {
 protected:
  /// Writes, reads back, and checks the size.
  Image roundTrip(const Image& image, const std::string& name, const WriteOptions& options = {}) {
    const Status written = write(image, folder_ / name, options);
    EXPECT_TRUE(written) << (written ? "" : written.error().message);
    Result<Image> back = read(folder_ / name);
    EXPECT_TRUE(back) << (back ? "" : back.error().message);
    if (!back) return {};
    EXPECT_EQ(back->width, image.width);
    EXPECT_EQ(back->height, image.height);
    return std::move(*back);
  }
};

TEST_F(ImageIo, ExrFloatKeepsEveryBit) {
  Image image = noise(37, 23, 1e6f);
  image.at(0, 0) = Rgb(-1.5f, std::numeric_limits<float>::infinity(), 1e-42f);
  image.at(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  const Image back = roundTrip(image, "a.exr");
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  EXPECT_EQ(std::memcmp(back.pixels.data(), image.pixels.data(), image.pixels.size() * sizeof(Rgb)),
            0);
  EXPECT_TRUE(back.alpha.empty());
}

TEST_F(ImageIo, ExrHalfKeepsHalfValuesAndClampsWhatIsTooLarge) {
  Image image(64, 3);
  Sequence sequence(3);
  for (Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      pixel[c] = std::ldexp(static_cast<float>(sequence.bits() % 2048), int(c) * 4 - 8);
    }
  }
  const WriteOptions half{.halfFloat = true, .layers = {}};
  const Image back = roundTrip(image, "a.exr", half);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    ASSERT_TRUE((back.pixels[i] == image.pixels[i]).all()) << i;
  }
  image.at(0, 0)[0] = 1e9f;
  EXPECT_EQ(roundTrip(image, "b.exr", half).at(0, 0)[0], 65504.0f);
}

TEST_F(ImageIo, ExrKeepsAlphaAndLayers) {
  Image image = noise(9, 7);
  image.alpha.assign(image.pixels.size(), 0.25f);
  const Image variance = noise(9, 7, 1.0f, 2);
  WriteOptions options;
  options.layers.emplace_back("variance", &variance);
  const Image back = roundTrip(image, "a.exr", options);
  EXPECT_EQ(back.alpha, image.alpha);
  EXPECT_TRUE((back.at(4, 4) == image.at(4, 4)).all());
  const Image other(3, 3);
  options.layers.emplace_back("other", &other);
  const Status status = write(image, folder_ / "b.exr", options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadUsage);
  EXPECT_FALSE(fs::exists(folder_ / "b.exr"));
}

TEST_F(ImageIo, HdrKeepsOnePerCentOfTheLargestChannel) {
  for (const int width : {3, 8, 200}) {  // below 8 pixels: no runs
    Image image(width, 40);
    Sequence sequence(width);
    for (Rgb& pixel : image.pixels) {
      const float scale = std::exp2(40.0f * sequence.next() - 20.0f);
      for (int c = 0; c < 3; ++c) pixel[c] = scale * sequence.next();
    }
    for (int x = 0; x < width; ++x) image.at(x, 7) = Rgb(1, 1, 1);  // one long run
    image.at(2, 3).setZero();
    const Image back = roundTrip(image, "a.hdr");
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const float step = image.pixels[i].maxCoeff() / 128.0f;
      ASSERT_LE((back.pixels[i] - image.pixels[i]).abs().maxCoeff(), 0.51f * step) << i;
    }
    EXPECT_TRUE((back.at(1, 7) == 1.0f).all());
    EXPECT_TRUE((back.at(2, 3) == 0.0f).all());
  }
}

TEST_F(ImageIo, HdrWritesAnyFloat) {
  Image image(8, 1);
  image.at(0, 0) = Rgb(-1.0f, std::nanf(""), std::numeric_limits<float>::infinity());
  image.at(1, 0) = Rgb(std::numeric_limits<float>::max(), 1e-40f, 0.0f);
  image.at(2, 0) = Rgb(0.9999f, 0.0f, 0.0f);  // the mantissa rounds up to 256
  const Image back = roundTrip(image, "a.hdr");
  EXPECT_EQ(back.at(0, 0)[0], 0.0f);
  EXPECT_EQ(back.at(0, 0)[1], 0.0f);
  EXPECT_GT(back.at(0, 0)[2], 1e38f);
  EXPECT_NEAR(back.at(2, 0)[0], 1.0f, 0.005f);
}

// A 2-wide, 3-high picture in the plain layout, whose red mantissas are 128 + the place in the
// file, green 0, blue 0: values 1, 1.0078, …
std::string plainHdr(const std::string& header, const std::string& resolution) {
  std::string file = "#?RADIANCE\n" + header + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
  for (int i = 0; i < 6; ++i) file += {static_cast<char>(128 + i), 0, 0, static_cast<char>(129)};
  return file;
}

TEST_F(ImageIo, HdrOrientations) {
  struct Case {
    const char* resolution;
    std::array<int, 6> expected;  ///< place in the file of the pixels, row after row from the top
  };
  for (const Case& c :
       {Case{"-Y 3 +X 2", {0, 1, 2, 3, 4, 5}}, Case{"+Y 3 +X 2", {4, 5, 2, 3, 0, 1}},
        Case{"-Y 3 -X 2", {1, 0, 3, 2, 5, 4}}, Case{"+Y 3 -X 2", {5, 4, 3, 2, 1, 0}},
        Case{"+X 2 -Y 3", {0, 3, 1, 4, 2, 5}}, Case{"+X 2 +Y 3", {2, 5, 1, 4, 0, 3}},
        Case{"-X 2 -Y 3", {3, 0, 4, 1, 5, 2}}, Case{"-X 2 +Y 3", {5, 2, 4, 1, 3, 0}}}) {
    const Result<Image> image = decode(bytesOf(plainHdr("", c.resolution)), c.resolution);
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 2);
    ASSERT_EQ(image->height, 3);
    for (size_t i = 0; i < 6; ++i) {
      EXPECT_FLOAT_EQ(image->pixels[i][0], 1.0f + static_cast<float>(c.expected[i]) / 128.0f)
          << c.resolution << " pixel " << i;
    }
  }
}

TEST_F(ImageIo, HdrExposureIsDividedOutAndGammaIsNot) {
  const Result<Image> image = decode(
      bytesOf(plainHdr("EXPOSURE=2\nGAMMA=2.2\nEXPOSURE= 4.0\nCOLORCORR= 0.5 1 1\n# EXPOSURE=9\n",
                       "-Y 3 +X 2")),
      "x.hdr");
  ASSERT_TRUE(image);
  EXPECT_FLOAT_EQ(image->at(0, 0)[0], 1.0f / (2.0f * 4.0f * 0.5f));
}

TEST_F(ImageIo, HdrOldRuns) {
  std::string file = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 300\n";
  file += std::string("\x80\x00\x00\x81", 4) + std::string("\x01\x01\x01\x2a", 4);  // 1 + 42
  file += std::string("\x01\x01\x01\x01", 4);                                       // + 256
  file += std::string("\xff\x00\x00\x81", 4);                                       // the last
  const Result<Image> image = decode(bytesOf(file), "old.hdr");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_FLOAT_EQ(image->at(298, 0)[0], 1.0f);
  EXPECT_FLOAT_EQ(image->at(299, 0)[0], 255.0f / 128.0f);
}

TEST_F(ImageIo, PngIsSrgbEncodedAndClamped) {
  Image image(256, 1);
  for (int x = 0; x < 256; ++x) {
    const float linear = radiometry::srgbDecode(static_cast<float>(x) / 255.0f);
    image.at(x, 0) = Rgb(linear, linear, linear);
  }
  const Image back = roundTrip(image, "a.png");
  for (int x = 0; x < 256; ++x) ASSERT_FLOAT_EQ(back.at(x, 0)[1], image.at(x, 0)[1]) << x;
  image.at(0, 0) = Rgb(-3.0f, 7.0f, std::nanf(""));
  const Image clamped = roundTrip(image, "b.png");
  EXPECT_TRUE((clamped.at(0, 0) == Rgb(0, 1, 0)).all());

  const Result<std::vector<std::byte>> file = file::readWhole(folder_ / "a.png");
  ASSERT_TRUE(file);
  const Result<Pixels8> pixels = decode8(*file, "a.png");
  ASSERT_TRUE(pixels);
  for (int x = 0; x < 256; ++x) {
    ASSERT_EQ(pixels->rgba[4 * size_t(x) + 2], x);
    ASSERT_EQ(pixels->rgba[4 * size_t(x) + 3], 255);
  }
}

TEST_F(ImageIo, PngKeepsColourApartFromCoverage) {
  Image image(2, 1);
  image.at(0, 0) = Rgb(0.25f, 0.125f, 0.0f);
  image.alpha = {0.5f, 0.0f};
  const Image back = roundTrip(image, "a.png");
  ASSERT_EQ(back.alpha.size(), 2u);
  EXPECT_NEAR(back.alpha[0], 0.5f, 0.003f);
  EXPECT_NEAR(back.at(0, 0)[0], 0.25f, 0.003f);
  EXPECT_NEAR(back.at(0, 0)[1], 0.125f, 0.003f);
  const Result<std::vector<std::byte>> file = file::readWhole(folder_ / "a.png");
  ASSERT_TRUE(file);
  const Result<Pixels8> pixels = decode8(*file);
  ASSERT_TRUE(pixels);
  EXPECT_EQ(pixels->rgba[0], 188);  // sRGB of one half
  EXPECT_EQ(pixels->rgba[3], 128);
}

TEST_F(ImageIo, SixteenBitPng) {
  // 2×1, greyscale, 16 bits, made by hand: zlib's "stored" block of 5 bytes.
  const auto bigEndian = [](std::uint32_t v) {
    return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16),
                       static_cast<char>(v >> 8), static_cast<char>(v)};
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    std::uint32_t c = 0xffffffffu;  // bit by bit: independent of the reader's table
    for (const char byte : type + data) {
      c ^= static_cast<unsigned char>(byte);
      for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    }
    return bigEndian(static_cast<std::uint32_t>(data.size())) + type + data + bigEndian(~c);
  };
  const std::string raw("\x00\x80\x00\x00\x01", 5);  // filter 0, values 0x8000 and 0x0001
  std::uint32_t a = 1, b = 0;
  for (const char byte : raw) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string png =
      "\x89PNG\r\n\x1a\n" +
      chunk("IHDR", bigEndian(2) + bigEndian(1) + std::string("\x10\x00\x00\x00\x00", 5)) +
      chunk("IDAT", std::string("\x78\x01\x01\x05\x00\xfa\xff", 7) + raw + bigEndian(b << 16 | a)) +
      chunk("IEND", "");
  const Result<Image> image = decode(bytesOf(png), "grey16.png");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_FLOAT_EQ(image->at(0, 0)[2], radiometry::srgbDecode(32768.0f / 65535.0f));
  EXPECT_FLOAT_EQ(image->at(1, 0)[0], radiometry::srgbDecode(1.0f / 65535.0f));
}

TEST_F(ImageIo, ContentDecidesNotTheName) {
  ASSERT_TRUE(write(noise(8, 8), folder_ / "a.hdr"));
  fs::rename(folder_ / "a.hdr", folder_ / "a.exr");
  EXPECT_TRUE(read(folder_ / "a.exr"));
}

TEST_F(ImageIo, MessagesNameTheFileAndTheRemedy) {
  const Result<Image> missing = read(folder_ / "missing.exr");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::BadInput);
  EXPECT_NE(missing.error().message.find("missing.exr"), std::string::npos);
  ASSERT_TRUE(file::writeAtomically(folder_ / "text.png", "no picture"));
  const Result<Image> text = read(folder_ / "text.png");
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().message.find("not a picture"), std::string::npos);
  const Status status = write(noise(2, 2), folder_ / "a.tiff");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadUsage);
  EXPECT_NE(status.error().message.find(".exr, .hdr or .png"), std::string::npos);
  EXPECT_TRUE(write(noise(2, 2), folder_ / "A.PNG"));
  EXPECT_FALSE(write(noise(2, 2), folder_ / "nowhere" / "a.png"));
  EXPECT_FALSE(write(Image(), folder_ / "empty.png"));
}

TEST_F(ImageIo, MakeRadiance) {
  const float infinity = std::numeric_limits<float>::infinity();
  Image image(2, 2);
  image.at(0, 0) = Rgb(1.0f, 2.0f, 3.0f);
  image.at(1, 0) = Rgb(infinity, -0.5f, std::nanf(""));
  image.at(0, 1) = Rgb(-infinity, 0.0f, 7.0f);
  const Repairs repairs = makeRadiance(image);
  EXPECT_EQ(repairs.infinite, 1u);
  EXPECT_EQ(repairs.negative, 2u);
  EXPECT_EQ(repairs.notANumber, 1u);
  EXPECT_TRUE((image.at(1, 0) == Rgb(1.0f, 0.0f, 0.0f)).all());
  EXPECT_TRUE((image.at(0, 1) == Rgb(0.0f, 0.0f, 7.0f)).all());
  EXPECT_EQ(makeRadiance(image).total(), 0u);
}

TEST_F(ImageIo, LayersAreReadByName) {
  const Image image = noise(9, 7, 2.0f), variance = noise(9, 7, 0.1f, 5);
  WriteOptions options;
  options.layers.emplace_back("variance", &variance);
  ASSERT_TRUE(write(image, folder_ / "a.exr", options));
  const Result<Image> layer = readLayer(folder_ / "a.exr", "variance");
  ASSERT_TRUE(layer);
  for (size_t i = 0; i < variance.pixels.size(); ++i)
    ASSERT_TRUE((layer->pixels[i] == variance.pixels[i]).all());
  EXPECT_EQ(readLayer(folder_ / "a.exr", "depth").error().kind, ErrorKind::BadInput);
  ASSERT_TRUE(write(image, folder_ / "a.png"));
  EXPECT_FALSE(readLayer(folder_ / "a.png", "variance"));
}

}  // namespace
}  // namespace lambent::image
