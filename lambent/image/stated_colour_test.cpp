// What Radiance pictures, PNG and JPEG say that their numbers mean.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/image/io.h"
#include "lambent/image/test_codecs.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

/// One pixel of mantissas 64, 128 and 255 and an exponent of 1.
PictureFile readOnePixelHdr(const std::string& lines, const std::string& format = "rgbe") {
  const std::string file = "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_" + format +
                           "\n\n-Y 1 +X 1\n" + std::string("\x40\x80\xff\x81", 4);
  Result<PictureFile> picture = decodePicture(bytesOf(file), "a.hdr");
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
  return picture ? std::move(*picture) : PictureFile{};
}

const Rgb kPixel(0.5f, 1.0f, 255 / 128.0f);

void expectNear(const Rgb& is, const Rgb& expected, float within) {
  EXPECT_LT((is - expected).abs().maxCoeff(), within) << is.transpose();
}

TEST(StatedColour, HdrPrimaries) {
  const PictureFile plain = readOnePixelHdr("");
  expectNear(plain.image.at(0, 0), kPixel, 1e-6f);
  EXPECT_FALSE(plain.converted);
  const PictureFile same = readOnePixelHdr("PRIMARIES= .64 .33 .30 .60 .15 .06 .3127 .3290\n");
  EXPECT_TRUE((same.image.at(0, 0) == plain.image.at(0, 0)).all());
  // ITU-R BT.2087: Rec. 2020 → Rec. 709.
  const PictureFile wide = readOnePixelHdr("PRIMARIES=.708 .292 .170 .797 .131 .046 .3127 .3290\n");
  expectNear(
      wide.image.at(0, 0),
      Rgb(1.6605f * .5f - .5876f - .0728f * kPixel[2], -.1246f * .5f + 1.1329f - .0083f * kPixel[2],
          -.0182f * .5f - .1006f + 1.1187f * kPixel[2]),
      1e-3f);
  EXPECT_TRUE(wide.converted);
  EXPECT_TRUE(wide.findings.empty());
}

TEST(StatedColour, HdrXyze) {
  const PictureFile picture = readOnePixelHdr("", "xyze");
  // IEC 61966-2-1.
  const Rgb expected(3.2406f * .5f - 1.5372f - .4986f * kPixel[2],
                     -.9689f * .5f + 1.8758f + .0415f * kPixel[2],
                     .0557f * .5f - .2040f + 1.0570f * kPixel[2]);
  expectNear(picture.image.at(0, 0), expected, 2e-3f);
}

TEST(StatedColour, WhatAnHdrSaysInVainIsTold) {
  const PictureFile picture =
      readOnePixelHdr("PRIMARIES= 1 2 3\nGAMMA=2.2\nPIXASPECT=2\nVIEW=rvu\n");
  expectNear(picture.image.at(0, 0), kPixel, 1e-6f);
  ASSERT_EQ(picture.findings.size(), 3u);
  EXPECT_EQ(picture.findings[0].code, "colour-primaries");
  EXPECT_EQ(picture.findings[1].code, "colour-not-linear");
  EXPECT_EQ(picture.findings[2].code, "pixel-aspect");
  EXPECT_TRUE(readOnePixelHdr("GAMMA=1\n").findings.empty());
}

/// A PNG of one grey-blue pixel with chunks behind its header, in place of the gAMA that makePng writes.
PictureFile readPngWith(const std::string& chunks, bool plainCodes = false) {
  std::string file =
      makePng(1, 1, {}, [](int, int, int channel) { return channel == 2 ? 200u : 100u; });
  const std::string gamma = pngChunk("gAMA", bigEndian(45455));
  file.replace(file.find(gamma), gamma.size(), chunks);
  Result<PictureFile> picture = decodePicture(
      bytesOf(file), "a.png", {.memoryLimit = {}, .layer = {}, .plainCodes = plainCodes});
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
  return picture ? std::move(*picture) : PictureFile{};
}

std::string chromaticitiesOf(const std::vector<double>& xy) {
  std::string data;
  for (const double v : xy) data += bigEndian(static_cast<std::uint32_t>(std::lround(100000 * v)));
  return pngChunk("cHRM", data);
}

const float kCode = 100 / 255.0f;

TEST(StatedColour, PngGamma) {
  const float srgb = radiometry::srgbDecode(kCode);
  EXPECT_FLOAT_EQ(readPngWith("").image.at(0, 0)[0], srgb);
  EXPECT_FLOAT_EQ(readPngWith(pngChunk("gAMA", bigEndian(45455))).image.at(0, 0)[0], srgb);
  const std::string linear = pngChunk("gAMA", bigEndian(100000));
  EXPECT_FLOAT_EQ(readPngWith(linear).image.at(0, 0)[0], kCode);
  EXPECT_FLOAT_EQ(readPngWith(linear, true).image.at(0, 0)[0], srgb);
  // sRGB outranks it.
  EXPECT_FLOAT_EQ(readPngWith(pngChunk("sRGB", std::string(1, 0)) + linear).image.at(0, 0)[0],
                  srgb);
  EXPECT_FLOAT_EQ(readPngWith(pngChunk("gAMA", bigEndian(0))).image.at(0, 0)[0], srgb);
}

TEST(StatedColour, PngPrimaries) {
  const std::string linear = pngChunk("gAMA", bigEndian(100000));
  const std::string wide = chromaticitiesOf({.3127, .3290, .708, .292, .170, .797, .131, .046});
  const float b = 200 / 255.0f;
  expectNear(readPngWith(linear + wide).image.at(0, 0),
             Rgb(kCode + .0728f * (kCode - b), kCode + .0083f * (kCode - b),
                 b - (1.1187f - 1) * (kCode - b)),
             1e-3f);
  EXPECT_TRUE(readPngWith(linear + wide).converted);
  const std::string own = chromaticitiesOf({.3127, .3290, .64, .33, .30, .60, .15, .06});
  EXPECT_FALSE(readPngWith(own).converted);
}

TEST(StatedColour, ProfilesThatAreNotUsedAreTold) {
  const std::string wide = pngChunk("iCCP", std::string("Display P3\0\0x", 13));
  const PictureFile picture = readPngWith(wide);
  ASSERT_EQ(picture.findings.size(), 1u);
  EXPECT_EQ(picture.findings[0].code, "colour-profile");
  EXPECT_NE(picture.findings[0].message.find("Display P3"), std::string::npos);
  EXPECT_TRUE(
      readPngWith(pngChunk("iCCP", std::string("sRGB IEC61966-2.1\0\0x", 20))).findings.empty());

  std::string jpeg = makeJpeg(8, 8, {}, [](int, int, int) { return 128; });
  const Result<PictureFile> plain = decodePicture(bytesOf(jpeg), "a.jpg");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_TRUE(plain->codes);
  EXPECT_TRUE(plain->findings.empty());
  const std::string profile = "ICC_PROFILE" + std::string("\0\1\1", 3) + "Adobe RGB (1998)";
  jpeg.insert(2, std::string("\xff\xe2\0", 3) + static_cast<char>(profile.size() + 2) + profile);
  const Result<PictureFile> told = decodePicture(bytesOf(jpeg), "a.jpg");
  ASSERT_TRUE(told) << told.error().message;
  ASSERT_EQ(told->findings.size(), 1u);
  EXPECT_EQ(told->findings[0].code, "colour-profile");
}

}  // namespace
}  // namespace lambent::image
