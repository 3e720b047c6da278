// Maps of all directions in the orientation of OpenEXR's attribute `envmap`.
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "lambent/image/io.h"
#include "lambent/image/project.h"
#include "lambent/image/test_exr.h"
#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

class ExrEnvmap : public FolderTest {
 protected:
  std::string path() const { return (folder_ / "a.exr").string(); }
};

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

TEST_F(ExrEnvmap, EnvmapCubeAndLatLongAreTheSameLight) {
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

TEST_F(ExrEnvmap, EnvmapCubesOfOtherShapesAreRefused) {
  ExrPart part{"", rgbOf("", 1, 1, 1)};
  Imf::addEnvmap(part.header, Imf::ENVMAP_CUBE);
  writeExrParts(path(), {part});
  const Result<PictureFile> picture = readPicture(path());
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().message.find("says that it is a cube map, but has 8 x 4"),
            std::string::npos);
}

}  // namespace
}  // namespace lambent::image
