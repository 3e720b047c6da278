// Which of the channels in an OpenEXR file become the picture, and what they become.
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "lambent/image/io.h"
#include "lambent/image/test_exr.h"
#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

constexpr float kTaken[3] = {2, 1, 0.5f};

std::map<std::string, float> taken(const std::string& layer) {
  return rgbOf(layer, kTaken[0], kTaken[1], kTaken[2]);
}

std::map<std::string, float> other(const std::string& layer) {
  return rgbOf(layer, 0.25f, 0.25f, 0.25f);
}

bool tells(const Findings& findings, const std::string& code) {
  for (const Finding& finding : findings)
    if (finding.code == code) return true;
  return false;
}

class ExrChoice : public FolderTest {
 protected:
  std::string path() const { return (folder_ / "a.exr").string(); }
  PictureFile readParts(std::vector<ExrPart> parts, const std::string& layer = {}) {
    writeExrParts(path(), std::move(parts));
    Result<PictureFile> picture = readPicture(path(), {.memoryLimit = {}, .layer = layer});
    EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
    return picture ? std::move(*picture) : PictureFile{Image(8, 4), {}, false, false, {}};
  }
  static void expectTaken(const PictureFile& picture, const std::string& what) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.image.at(3, 2)[c], kTaken[c], 1e-5f) << what << " channel " << c;
  }
};

TEST_F(ExrChoice, LayersByTheirNames) {
  const std::map<std::string, float> depth{{"ViewLayer.Depth.Z", 9.0f}};
  const std::vector<std::pair<const char*, std::map<std::string, float>>> files{
      {"Blender", other("ViewLayer.AO") + taken("ViewLayer.Combined") + depth},
      {"Blender's albedo", other("ViewLayer.Denoising Albedo") + other("ViewLayer.DiffCol") +
                               taken("ViewLayer.Noisy Image")},
      {"two views", other("ViewLayer.Combined.right") + taken("ViewLayer.Combined.left")},
      {"unnamed", other("beauty") + taken("") + other("AO")},
      {"beauty", other("albedo") + taken("beauty") + other("diffuse")},
      {"rgba", other("N") + taken("rgba") + other("crypto00")},
      {"unknown before shares", other("Emission") + taken("kitchen")},
      {"shares before none", other("AO") + taken("GI") + other("worldNormal")},
      {"pbrt", taken("") + other("Albedo") +
                   std::map<std::string, float>{{"P.X", 5.0f}, {"P.Y", 5.0f}, {"P.Z", 5.0f}}},
      {"depth beside", taken("main") + std::map<std::string, float>{{"Z", 9.0f}}}};
  for (const auto& [name, channels] : files) {
    const PictureFile picture = readParts({{"", channels}});
    expectTaken(picture, name);
    ASSERT_TRUE(tells(picture.findings, "exr-layers")) << name;
  }
}

TEST_F(ExrChoice, NothingIsToldWhereNothingIsLeft) {
  EXPECT_TRUE(
      readParts({{"", taken("") + std::map<std::string, float>{{"A", 1.0f}}}}).findings.empty());
  EXPECT_TRUE(readParts({{"", taken("ViewLayer.Combined")}}).findings.empty());
}

TEST_F(ExrChoice, TheFindingNamesWhatIsTakenAndLeft) {
  const PictureFile picture =
      readParts({{"", taken("ViewLayer.Combined") + other("ViewLayer.AO") +
                          std::map<std::string, float>{{"ViewLayer.Depth.Z", 9.0f}}}});
  ASSERT_EQ(picture.findings.size(), 1u);
  EXPECT_EQ(picture.findings[0].severity, Severity::Note);
  EXPECT_EQ(picture.findings[0].count, 2u);
  const std::string& message = picture.findings[0].message;
  for (const char* word : {"a.exr", "ViewLayer.Combined", "ViewLayer.AO (B G R)",
                           "ViewLayer.Depth (Z)", "FILE.exr:LAYER"})
    EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST_F(ExrChoice, ChannelsBesideColourAreTold) {
  const PictureFile picture =
      readParts({{"", taken("") + std::map<std::string, float>{{"A", 1.0f}, {"Z", 9.0f}}}});
  expectTaken(picture, "depth beside");
  ASSERT_EQ(picture.findings.size(), 1u);
  EXPECT_NE(picture.findings[0].message.find("is (A B G R); left: (Z)."), std::string::npos)
      << picture.findings[0].message;
}

TEST_F(ExrChoice, PartsByTheirNamesAndChannels) {
  const std::map<std::string, float> depth{{"Z", 5.0f}};
  const std::map<std::string, float> normal{{"N.X", 0.0f}, {"N.Y", 1.0f}, {"N.Z", 0.0f}};
  const std::map<std::string, float> places{{"X", 7.0f}, {"Y", 7.0f}, {"Z", 7.0f}};
  expectTaken(readParts({{"depth", depth}, {"rgb", taken("")}}), "depth first");
  expectTaken(readParts({{"N", normal}, {"rgb", taken("")}}), "normals first");
  expectTaken(readParts({{"position", places}, {"any", taken("")}}), "places first");
  expectTaken(readParts({{"albedo", other("")}, {"beauty", taken("")}}), "albedo first");
  expectTaken(readParts({{"albedo", other("rgba")}, {"rgba", taken("rgba")}}), "both rgba");
  expectTaken(readParts({{"diffuse", other("")}, {"C", taken("C")}}), "Karma");
}

/// A part of one deep sample a pixel, and after it, if `colour`, a flat one.
void writeDeepFirst(const std::string& path, bool colour) {
  std::vector<Imf::Header> headers(colour ? 2 : 1, Imf::Header(8, 4));
  headers[0].setName("deep");
  headers[0].setType(Imf::DEEPSCANLINE);
  headers[0].compression() = Imf::ZIPS_COMPRESSION;
  headers[0].channels().insert("R", Imf::Channel(Imf::FLOAT));
  if (colour) {
    headers[1].setName("flat");
    headers[1].setType(Imf::SCANLINEIMAGE);
    for (const auto& [name, value] : taken(""))
      headers[1].channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  std::vector<unsigned> counts(32, 1);
  std::vector<float> samples(32, 7.0f);
  std::vector<float*> pointers;
  for (float& sample : samples) pointers.push_back(&sample);
  Imf::DeepFrameBuffer deep;
  deep.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()),
                                         sizeof(unsigned), 8 * sizeof(unsigned)));
  deep.insert("R", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()),
                                  sizeof(float*), 8 * sizeof(float*), sizeof(float)));
  Imf::DeepScanLineOutputPart first(file, 0);
  first.setFrameBuffer(deep);
  first.writePixels(4);
  if (!colour) return;
  std::map<std::string, std::vector<float>> planes;
  Imf::FrameBuffer frame;
  for (const auto& [name, value] : taken("")) {
    planes[name].assign(32, value);
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, planes[name].data(), headers[1].dataWindow()));
  }
  Imf::OutputPart second(file, 1);
  second.setFrameBuffer(frame);
  second.writePixels(4);
}

TEST_F(ExrChoice, DeepPartsAreLeftAndTold) {
  writeDeepFirst(path(), true);
  const Result<PictureFile> picture = readPicture(path());
  ASSERT_TRUE(picture) << picture.error().message;
  expectTaken(*picture, "deep first");
  ASSERT_EQ(picture->findings.size(), 1u);
  EXPECT_NE(picture->findings[0].message.find("1 part(s) with deep pixels"), std::string::npos);
  writeDeepFirst(path(), false);
  const Result<PictureFile> deep = readPicture(path());
  ASSERT_FALSE(deep);
  EXPECT_NE(deep.error().message.find("deep pixels cannot be read; flatten"), std::string::npos);
}

TEST_F(ExrChoice, TheFirstViewIsTaken) {
  ExrPart right{"rgb.right", other("")}, left{"rgb.left", taken("")};
  right.header.setView("right"), left.header.setView("left");
  expectTaken(readParts({right, left}), "left before right");
  Imf::Header views(8, 4);
  Imf::addMultiView(views, {"right", "left"});
  expectTaken(readParts({{"", other("left") + taken(""), views}}), "the default view has no name");
}

TEST_F(ExrChoice, ALayerThatIsAskedFor) {
  const std::vector<ExrPart> parts{
      {"first", taken("ViewLayer.AO") + other("ViewLayer.Combined") +
                    std::map<std::string, float>{{"Z", 7.0f}}},
      {"second", other("") + std::map<std::string, float>{{"A", 1.0f}}}};
  for (const char* layer : {"AO", "ao", "ViewLayer.AO", "first.ViewLayer.AO"}) {
    const PictureFile picture = readParts(parts, layer);
    expectTaken(picture, layer);
    EXPECT_TRUE(picture.findings.empty()) << layer;  // it was asked for
  }
  EXPECT_EQ(readParts(parts, "second").image.at(0, 0)[0], 0.25f);
  EXPECT_EQ(readParts(parts, "Z").image.at(0, 0)[2], 7.0f);
  const Result<PictureFile> none = readPicture(path(), {.memoryLimit = {}, .layer = "diffuse"});
  ASSERT_FALSE(none);
  for (const char* word : {"a.exr", "no layer diffuse", "ViewLayer.AO (B G R)", "second"})
    EXPECT_NE(none.error().message.find(word), std::string::npos) << none.error().message;
}

TEST_F(ExrChoice, WhatMayBeNoLightIsAWarning) {
  for (const auto& channels : {std::map<std::string, float>{{"Z", 5.0f}}, other("albedo")}) {
    const PictureFile picture = readParts({{"", channels}});
    ASSERT_EQ(picture.findings.size(), 1u);
    EXPECT_EQ(picture.findings[0].severity, Severity::Warning);
  }
}

ExrPart withChromaticities(const std::map<std::string, float>& channels,
                           const Imf::Chromaticities& chromaticities) {
  ExrPart part{"", channels};
  Imf::addChromaticities(part.header, chromaticities);
  return part;
}

void expectColour(const PictureFile& picture, const Rgb& expected, float within) {
  const Rgb& is = picture.image.at(2, 2);
  EXPECT_LT((is - expected).abs().maxCoeff(), within) << is.transpose();
}

TEST_F(ExrChoice, StatedPrimariesBecomeRec709) {
  const Imf::Chromaticities ap1({.713f, .293f}, {.165f, .830f}, {.128f, .044f}, {.32168f, .33767f});
  // The inverse of ACES' AP1 → Rec. 709, applied to (1, 0.2, 0.1).
  const auto acesCg = rgbOf("", 0.685721f, 0.2548f, 0.129502f);
  expectColour(readParts({withChromaticities(acesCg, ap1)}), Rgb(1, 0.2f, 0.1f), 1e-3f);
  EXPECT_TRUE(readParts({withChromaticities(acesCg, ap1)}).converted);
  // Those of Rec. 709 change nothing, not even by rounding.
  const PictureFile same = readParts({withChromaticities(taken(""), Imf::Chromaticities())});
  EXPECT_EQ(same.image.at(1, 1)[0], 2.0f);
  EXPECT_FALSE(same.converted);
  // White stays white.
  expectColour(readParts({withChromaticities(rgbOf("", 3, 3, 3), ap1)}), Rgb(3, 3, 3), 1e-3f);
}

TEST_F(ExrChoice, XyzIsTakenAsMeasured) {
  // (1, 0.2, 0.1) of Rec. 709 in XYZ.
  const Imf::Chromaticities xyz({1, 0}, {0, 1}, {0, 0}, {1 / 3.f, 1 / 3.f});
  const Rgb colour(1, 0.2f, 0.1f);
  expectColour(readParts({{"", {{"X", .5019581f}, {"Y", .3629047f}, {"Z", .1382059f}}}}), colour,
               1e-3f);
  expectColour(readParts({withChromaticities(rgbOf("", .5019581f, .3629047f, .1382059f), xyz)}),
               colour, 1e-3f);
}

TEST_F(ExrChoice, PrimariesByTheNameOfASpace) {
  ExrPart named{"", rgbOf("", 0.685721f, 0.2548f, 0.129502f)};
  named.header.insert("colorInteropID", Imf::StringAttribute("lin_ap1_scene"));
  expectColour(readParts({named}), Rgb(1, 0.2f, 0.1f), 1e-3f);
  ExrPart aces{"", rgbOf("", 1, 1, 1)};
  aces.header.insert("acesImageContainerFlag", Imf::IntAttribute(1));
  EXPECT_TRUE(readParts({aces}).converted);
  ExrPart encoded{"", taken("")};
  encoded.header.insert("oiio:ColorSpace", Imf::StringAttribute("sRGB"));
  const PictureFile picture = readParts({encoded});
  expectTaken(picture, "encoded");
  EXPECT_TRUE(tells(picture.findings, "colour-not-linear"));
}

TEST_F(ExrChoice, WhatIsStatedButCannotBeUsedIsTold) {
  const Imf::Chromaticities line({.1f, .1f}, {.2f, .2f}, {.3f, .3f}, {.2f, .2f});
  ExrPart part = withChromaticities(taken(""), line);
  Imf::addWhiteLuminance(part.header, 100.0f);
  part.header.pixelAspectRatio() = 2.0f;
  const PictureFile picture = readParts({part});
  expectTaken(picture, "odd");
  for (const char* code : {"colour-primaries", "white-luminance", "pixel-aspect"})
    EXPECT_TRUE(tells(picture.findings, code)) << code;
}

TEST_F(ExrChoice, WindowsThatDifferAreTold) {
  const Imath::Box2i display({0, 0}, {7, 3}), data({-2, 1}, {7, 3});
  ExrPart part{"", taken(""), Imf::Header(display, data)};
  const PictureFile picture = readParts({part});
  EXPECT_TRUE(tells(picture.findings, "exr-windows-black"));
  EXPECT_TRUE(tells(picture.findings, "exr-windows-cut"));
  EXPECT_EQ(picture.image.width, 8);
  // Of a map of all directions the data window is the map.
  Imf::addEnvmap(part.header, Imf::ENVMAP_LATLONG);
  const PictureFile map = readParts({part});
  EXPECT_EQ(map.map, MapKind::LatLong);
  EXPECT_EQ(map.image.width, 10);
  EXPECT_EQ(map.image.height, 3);
}

}  // namespace
}  // namespace lambent::image
