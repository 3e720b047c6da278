// What OpenEXR files may contain, written by OpenEXR itself.
#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <algorithm>

#include "lambent/file/atomic_file.h"
#include "lambent/image/io.h"
#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

using Imath::Box2i;
using Imath::V2i;

class ExrFiles : public FolderTest {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
};

std::vector<Imf::Rgba> asRgba(const Image& image) {
  std::vector<Imf::Rgba> pixels;
  for (const Rgb& p : image.pixels) pixels.emplace_back(p[0], p[1], p[2], 1.0f);
  return pixels;
}

float largestDifference(const Image& a, const Image& b) {
  float largest = 0.0f;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    largest = std::max(largest, (a.pixels[i] - b.pixels[i]).abs().maxCoeff());
  }
  return largest;
}

TEST_F(ExrFiles, EveryCompression) {
  const Image image = gradient(100, 300);  // more lines than one DWAB block
  const std::vector<Imf::Rgba> pixels = asRgba(image);
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
        Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
        Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    {
      Imf::Header header(image.width, image.height);
      header.compression() = compression;
      Imf::RgbaOutputFile file(path("a.exr").c_str(), header, Imf::WRITE_RGB);
      file.setFrameBuffer(pixels.data(), 1, image.width);
      file.writePixels(image.height);
    }
    const Result<Image> back = read(path("a.exr"));
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->width, 100);
    ASSERT_EQ(back->height, 300);
    EXPECT_LT(largestDifference(image, *back), 0.02f) << compression;
    EXPECT_TRUE(back->alpha.empty());
  }
}

TEST_F(ExrFiles, Chroma) {
  const Image image = gradient(64, 48);
  const std::vector<Imf::Rgba> pixels = asRgba(image);
  {
    Imf::RgbaOutputFile file(path("a.exr").c_str(), image.width, image.height, Imf::WRITE_YCA);
    file.setFrameBuffer(pixels.data(), 1, image.width);
    file.writePixels(image.height);
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_LT(largestDifference(image, *back), 0.02f);
  EXPECT_EQ(back->alpha.size(), back->pixels.size());
}

TEST_F(ExrFiles, Luminance) {
  const Image image = noise(20, 10);
  std::vector<Imf::Rgba> pixels;
  for (const Rgb& p : image.pixels) pixels.emplace_back(p[0], p[0], p[0], 1.0f);
  {
    Imf::RgbaOutputFile file(path("a.exr").c_str(), image.width, image.height, Imf::WRITE_Y);
    file.setFrameBuffer(pixels.data(), 1, image.width);
    file.writePixels(image.height);
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_NEAR(back->at(3, 4)[0], image.at(3, 4)[0], 2e-3f);
  EXPECT_EQ(back->at(3, 4)[0], back->at(3, 4)[2]);
}

TEST_F(ExrFiles, DataWindowIsPlacedInTheDisplayWindow) {
  // Display (10, 20)…(29, 39); data (5, 30)…(19, 49): cut at the left and below, black elsewhere.
  const Image data = noise(15, 20);
  const std::vector<Imf::Rgba> pixels = asRgba(data);
  {
    Imf::Header header(Box2i(V2i(10, 20), V2i(29, 39)), Box2i(V2i(5, 30), V2i(19, 49)));
    Imf::RgbaOutputFile file(path("a.exr").c_str(), header, Imf::WRITE_RGBA);
    file.setFrameBuffer(pixels.data() - 5 - 30 * 15, 1, 15);
    file.writePixels(20);
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->width, 20);
  ASSERT_EQ(back->height, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool inside = x + 10 <= 19 && y + 20 >= 30;
      const Rgb expected = inside ? data.at(x + 5, y - 10) : Rgb::Zero();
      ASSERT_LT((back->at(x, y) - expected).abs().maxCoeff(), 1e-3f) << x << " " << y;
      ASSERT_EQ(back->alpha[size_t(y) * 20 + x], inside ? 1.0f : 0.0f);
    }
  }
}

TEST_F(ExrFiles, TiledFloat) {
  const Image image = noise(70, 50, 1e5f);
  {
    Imf::Header header(70, 50);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setTileDescription(Imf::TileDescription(32, 16, Imf::MIPMAP_LEVELS));
    Imf::FrameBuffer frame;
    for (int c = 0; c < 3; ++c) {
      const char name[2] = {"RGB"[c], 0};
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice(Imf::FLOAT,
                                    reinterpret_cast<char*>(const_cast<Rgb*>(image.pixels.data())) +
                                        c * sizeof(float),
                                    sizeof(Rgb), 70 * sizeof(Rgb)));
    }
    Imf::TiledOutputFile file(path("a.exr").c_str(), header);
    file.setFrameBuffer(frame);
    for (int level = 0; level < file.numLevels(); ++level) {
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(largestDifference(image, *back), 0.0f);
}

TEST_F(ExrFiles, FirstPartLayersAndIntegerChannels) {
  constexpr int kWidth = 6, kHeight = 4;
  std::vector<std::uint32_t> counts(kWidth * kHeight);
  std::vector<Imath::half> halves(kWidth * kHeight);
  std::vector<float> floats(kWidth * kHeight);
  for (size_t i = 0; i < counts.size(); ++i) {
    counts[i] = static_cast<std::uint32_t>(1000 * i);
    halves[i] = Imath::half(0.5f * static_cast<float>(i));
    floats[i] = 0.1f * static_cast<float>(i);
  }
  {
    std::array<Imf::Header, 2> headers{Imf::Header(kWidth, kHeight), Imf::Header(kWidth, kHeight)};
    for (int i = 0; i < 2; ++i) {
      headers[i].setName(i == 0 ? "first" : "second");
      headers[i].setType(Imf::SCANLINEIMAGE);
    }
    headers[0].channels().insert("Z", Imf::Channel(Imf::FLOAT));
    headers[0].channels().insert("Beauty.R", Imf::Channel(Imf::UINT));
    headers[0].channels().insert("Beauty.G", Imf::Channel(Imf::HALF));
    headers[0].channels().insert("Beauty.B", Imf::Channel(Imf::FLOAT));
    headers[1].channels().insert("R", Imf::Channel(Imf::HALF));
    Imf::MultiPartOutputFile file(path("a.exr").c_str(), headers.data(), 2);
    Imf::FrameBuffer frame;
    const auto add = [&](const char* name, Imf::PixelType type, void* data, size_t size) {
      frame.insert(name, Imf::Slice(type, static_cast<char*>(data), size, size * kWidth));
    };
    add("Z", Imf::FLOAT, floats.data(), 4);
    add("Beauty.R", Imf::UINT, counts.data(), 4);
    add("Beauty.G", Imf::HALF, halves.data(), 2);
    add("Beauty.B", Imf::FLOAT, floats.data(), 4);
    add("R", Imf::HALF, halves.data(), 2);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(frame);
      part.writePixels(kHeight);
    }
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE((back->at(5, 3) == Rgb(23000.0f, 11.5f, 0.1f * 23.0f)).all());
}

TEST_F(ExrFiles, NoColourIsSaid) {
  std::vector<float> depth(4, 1.0f);
  {
    Imf::Header header(2, 2);
    Imf::FrameBuffer frame;
    for (const char* name : {"N.X", "N.Y"}) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depth.data()), 4, 8));
    }
    Imf::OutputFile file(path("a.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  const Result<Image> back = read(path("a.exr"));
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().message.find("neither channels R, G, B nor Y"), std::string::npos);
}

TEST_F(ExrFiles, ConstantPicturesPassTheSizeCheck) {
  // The check before memory is taken presumes a largest ratio of pixels to bytes: the most
  // compressible pictures must pass it.
  constexpr int kSize = 2048;
  const std::vector<Imf::Rgba> pixels(size_t(kSize) * kSize, Imf::Rgba(0, 0, 0, 0));
  for (const Imf::Compression compression :
       {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION,
        Imf::DWAB_COMPRESSION}) {
    {
      Imf::Header header(kSize, kSize);
      header.compression() = compression;
      Imf::RgbaOutputFile file(path("a.exr").c_str(), header, Imf::WRITE_Y);
      file.setFrameBuffer(pixels.data(), 1, kSize);
      file.writePixels(kSize);
    }
    const Result<Image> back = read(path("a.exr"));
    EXPECT_TRUE(back) << back.error().message;
  }
}

}  // namespace
}  // namespace lambent::image
