// Which of the channels in an OpenEXR file become the picture, and what they become.
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "lambent/image/io.h"
#include "lambent/image/project.h"
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

/// A smooth light, by directions of OpenEXR.
Rgb envmapLight(const Imath::V3f& d) {
  const Imath::V3f n = d.normalized();
  return Rgb(1 + 0.5f * n.x, 1 + 0.5f * n.y + 0.3f * n.x * n.z, 1 + 0.7f * n.z);
}

/// By the library's own functions from pixels to directions.
Image paintEnvmap(Imf::Envmap kind, int width, int height) {
  const Imath::Box2i window({0, 0}, {width - 1, height - 1});
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (kind == Imf::ENVMAP_LATLONG) {
        const Imath::V2f at(static_cast<float>(x), static_cast<float>(y));
        image.at(x, y) = envmapLight(Imf::LatLongMap::direction(window, at));
        continue;
      }
      const auto face = static_cast<Imf::CubeMapFace>(y / width);
      const Imath::V2f inFace(static_cast<float>(x), static_cast<float>(y % width));
      const Imath::V2f at = Imf::CubeMap::pixelPosition(face, window, inFace);
      image.at(int(std::lround(at.x)), int(std::lround(at.y))) =
          envmapLight(Imf::CubeMap::direction(face, window, inFace));
    }
  return image;
}

void writeEnvmap(const std::string& path, Imf::Envmap kind, int width, int height) {
  Image image = paintEnvmap(kind, width, height);
  Imf::Header header(width, height);
  Imf::addEnvmap(header, kind);
  Imf::FrameBuffer frame;
  for (int c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice(Imf::FLOAT,
                                  reinterpret_cast<char*>(image.pixels.data()) +
                                      std::size_t(c) * sizeof(float),
                                  sizeof(Rgb), sizeof(Rgb) * std::size_t(width)));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(height);
}

TEST_F(ExrChoice, EnvmapCubeAndLatLongAreTheSameLight) {
  writeEnvmap(path(), Imf::ENVMAP_LATLONG, 128, 64);
  const Result<PictureFile> latLong = readPicture(path());
  ASSERT_TRUE(latLong) << latLong.error().message;
  EXPECT_EQ(latLong->map, MapKind::LatLong);
  writeEnvmap(path(), Imf::ENVMAP_CUBE, 48, 288);
  const Result<PictureFile> cube = readPicture(path());
  ASSERT_TRUE(cube) << cube.error().message;
  EXPECT_EQ(cube->map, MapKind::Cube);
  const auto a = project(latLong->image, MapKind::LatLong, 3);
  const auto b = project(cube->image, MapKind::Cube, 3);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], 0.02f) << i;
  EXPECT_GT(std::abs(a.values[2]) + std::abs(a.values[3]), 0.5f);  // it has a direction
}

TEST_F(ExrChoice, EnvmapCubesOfOtherShapesAreRefused) {
  ExrPart part{"", taken("")};
  Imf::addEnvmap(part.header, Imf::ENVMAP_CUBE);
  writeExrParts(path(), {part});
  const Result<PictureFile> picture = readPicture(path());
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().message.find("says that it is a cube map, but has 8 x 4"),
            std::string::npos);
}

}  // namespace
}  // namespace lambent::image
