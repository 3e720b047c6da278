// Aerial perspective by OpenGL against the CPU's.

#include "lambent/render/gl_air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_picture.h"
#include "lambent/render/live_renderer.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/test_air.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::render {
namespace {

using image::Image;
using shade::PictureOptions;
using test::small;
using transfer::Encoding;

/// How bright the day is, so that surfaces and air are of one order, and pictures are looked at.
constexpr float kDay = 20.0f;

scene::Mesh box(const Vec3& center, const Vec3& half) {
  scene::Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const Vec3 n = side * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = n.cross(u);
      const auto first = std::uint32_t(mesh.positions.size());
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        mesh.positions.push_back(center + half.cwiseProduct(n + float(a) * u + float(b) * v));
        mesh.normals.push_back(n);
        mesh.uvs.emplace_back(0.5f * float(a + 1), 0.5f * float(b + 1));
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  return mesh;
}

/// A plane of 10 km with boxes that stand in a row, ever farther away; in units of `metres`. One of
/// them, if any, is a mirror.
asset::Asset longPlane(float metres, bool texels, std::optional<int> mirror = 2) {
  asset::Asset asset;
  const float unit = 1.0f / metres;
  const scene::Mesh ground = shade::test::floor(Vec3(0.0f, 0.0f, -4900.0f * unit), 5000.0f * unit);
  if (texels)
    shade::test::addTexels(asset, ground, Vec3::UnitY(), 16, 11, 4, Encoding::Float32);
  else
    shade::test::addDiffuse(asset, ground, {});
  for (int k = 0; k < 6; ++k) {
    const float away = 150.0f * std::pow(2.2f, float(k)), half = 0.12f * away;
    const float x = (float(k) - 2.5f) * 0.22f * away;
    const scene::Mesh mesh =
        box(Vec3(x, half, -away) * unit, Vec3(0.4f * half, half, 0.4f * half) * unit);
    if (k == mirror)
      shade::test::addMirror(asset, mesh, Rgb(0.9f, 0.8f, 0.7f));
    else if (k == 3)
      shade::test::addGlossy(asset, mesh, 5, 4, 1, Encoding::Float16);
    else
      shade::test::addDiffuse(asset, mesh, {5, 3, Encoding::Float16, false});
  }
  return asset;
}

scene::Camera cameraOver(float metres) {
  return shade::test::cameraAt(Vec3(0, 50 / metres, 60 / metres),
                               Vec3(0, 20 / metres, -900 / metres));
}

struct Pictures {
  Image cpu, gl;
};

Pictures picturesOf(const asset::Asset& asset, const scene::Camera& camera,
                    const PictureOptions& options) {
  const light::Environment sky = shade::test::sky();
  sh::RgbCoefficients light = sky.project(5);
  for (float& value : light.values) value *= kDay;
  auto cpu = reference::relitPicture(asset, light, sky, camera, options);
  auto gl = picture(asset, light, sky, camera, options);
  if (!cpu || !gl) {
    ADD_FAILURE() << (cpu ? gl.error().message : cpu.error().message);
    return {};
  }
  for (Image* image : {&*cpu, &*gl})
    for (Rgb& pixel : image->pixels) pixel /= kDay;
  return {std::move(*cpu), std::move(*gl)};
}

double meanChange(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += double((a.pixels[i] - b.pixels[i]).abs().mean());
  return sum / double(a.pixels.size());
}

TEST(GlAir, IsTheCpusOnALongPlane) {
  for (const bool texels : {false, true})
    for (const float metres : {1.0f, 1000.0f}) {
      const asset::Asset asset = longPlane(metres, texels);
      PictureOptions options = small(4);
      const Pictures without = picturesOf(asset, cameraOver(metres), options);
      options.air = shade::test::clearAir(double(metres));
      options.air->sunFromAsset = Eigen::AngleAxisd(0.8, Vec3d::UnitY()).toRotationMatrix();
      const Pictures with = picturesOf(asset, cameraOver(metres), options);
      test::expectSame("air-" + std::to_string(texels) + "-" + std::to_string(int(metres)),
                       with.cpu, with.gl,
                       {.mirrors = test::mirrorsIn(asset, cameraOver(metres), small(4))});
      EXPECT_GT(meanChange(with.gl, without.gl), 0.01);
    }
}

TEST(GlAir, IsTheCpusBeforeMesoStructure) {
  asset::Asset asset;
  shade::test::addPatched(asset, scene::translated(scene::gridPlane(12, 12, 4, 4), Vec3(0, -1, 0)),
                          shade::test::bumpyRtt(16, 16, 8, 5), {});
  const scene::Camera camera = shade::test::cameraAt(Vec3(1.0f, 1.0f, 3.5f), Vec3(0, -0.2f, 0));
  PictureOptions options = small(2);
  const Pictures without = picturesOf(asset, camera, options);
  options.air = shade::test::clearAir(1000);
  const Pictures with = picturesOf(asset, camera, options);
  test::expectSame("air-patch", with.cpu, with.gl);
  EXPECT_GT(meanChange(with.gl, without.gl), 0.01);
}

TEST(GlAir, ChangesNothingAtNoDistance) {
  // What mirrors show of the ground is as far away as ever.
  const asset::Asset asset = longPlane(1, false, std::nullopt);
  PictureOptions options = small(2);
  const Pictures without = picturesOf(asset, cameraOver(1), options);
  options.air = shade::test::clearAir(1e-9);
  const Pictures with = picturesOf(asset, cameraOver(1), options);
  EXPECT_LT(meanChange(with.cpu, without.cpu), 1e-6);
  EXPECT_LT(meanChange(with.gl, without.gl), 1e-6);
}

TEST(GlAir, FarAwayHidesWhatIsThere) {
  // A wall at the end of the air is the sky's colour, whatever it sends.
  PictureOptions options = small(1);
  options.air = shade::test::clearAir(1e6);
  const scene::Camera camera = shade::test::cameraAt(Vec3(0, 0, 5), Vec3(0, 0.02f, 0));
  asset::Asset asset;
  shade::test::addDiffuse(asset, box(Vec3(0, 0, 0), Vec3(40, 0.2f, 1)), {});
  const Pictures pictures = picturesOf(asset, camera, options);
  int seen = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3 direction =
          scene::cameraRay(camera, options.width, options.height, float(x) + 0.5f, float(y) + 0.5f)
              .direction;
      // Low over the horizon.
      if (pictures.gl.alpha[std::size_t(y * options.width + x)] < 1 || direction.y() < 0.001f ||
          direction.y() > 0.01f)
        continue;
      ++seen;
      const Rgb sky = options.air->seen(direction, 1e3f, Rgb::Zero()) / kDay;
      EXPECT_LT((pictures.gl.at(x, y) - sky).abs().maxCoeff(), 0.1f * sky.maxCoeff());
      EXPECT_LT((pictures.cpu.at(x, y) - pictures.gl.at(x, y)).abs().maxCoeff(),
                2e-3f * sky.maxCoeff());
    }
  EXPECT_GT(seen, 30);
}

/// The Sun of shade::test::clearAir.
light::Environment dayWithSun() {
  const float elevation = float(18 * kPi / 180);
  return light::Environment::uniform(Rgb(3.0f, 4.0f, 6.0f)) +
         light::Environment::disc(
             {.direction = Vec3(std::cos(elevation), std::sin(elevation), 0.0f),
              .angularDiameter = 0.0093,
              .irradiance = Rgb(60.0f, 54.0f, 45.0f)});
}

Pictures sunnyPictures(const asset::Asset& asset, const scene::Camera& camera,
                       PictureOptions options) {
  const light::Environment sky = dayWithSun();
  options.sun = shade::sharpSunOf(sky, std::vector<double>(5, 1.0));
  auto cpu = reference::relitPicture(asset, sky.project(5), sky, camera, options);
  auto gl = picture(asset, sky.project(5), sky, camera, options);
  if (!cpu || !gl) {
    ADD_FAILURE() << (cpu ? gl.error().message : cpu.error().message);
    return {};
  }
  for (Image* image : {&*cpu, &*gl})
    for (Rgb& pixel : image->pixels) pixel /= kDay;
  return {std::move(*cpu), std::move(*gl)};
}

// Units of a kilometre: towers in a row, across the Sun.
TEST(GlAir, ShaftsAreTheCpus) {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, 0, -1), 6.0f), {});
  for (int k = 0; k < 4; ++k)
    shade::test::addDiffuse(
        asset, box(Vec3(1.5f, 0.9f, 0.5f - 1.3f * float(k)), Vec3(0.2f, 0.9f, 0.4f)), {});
  const scene::Camera camera = shade::test::cameraAt(Vec3(-0.3f, 0.3f, 4), Vec3(0, 0.9f, -1));
  for (const bool background : {false, true}) {
    PictureOptions options = small(4);
    options.background = background;
    options.air = shade::test::clearAir(1000);
    const Pictures lit = sunnyPictures(asset, camera, options);
    options.air->shafts = shade::Shafts{};
    const Pictures shafts = sunnyPictures(asset, camera, options);
    // Borders of shadows differ by parts of a texel.
    test::expectSame("shafts-" + std::to_string(background), shafts.cpu, shafts.gl,
                     {.mean = 0.25, .interior = 8});
    // Shadows only take away.
    double taken = 0;
    for (std::size_t i = 0; i < lit.gl.pixels.size(); ++i) {
      EXPECT_LT((shafts.gl.pixels[i] - lit.gl.pixels[i]).maxCoeff(), 1e-4f);
      taken += double((lit.gl.pixels[i] - shafts.gl.pixels[i]).mean());
    }
    EXPECT_GT(taken / double(lit.gl.pixels.size()), 1e-3);
  }
}

TEST(GlAir, ShaftsWantShadows) {
  // Nothing stands between the air and the Sun.
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, 0, -1), 6.0f), {});
  const scene::Camera camera = shade::test::cameraAt(Vec3(0, 0.3f, 4), Vec3(0, 0.2f, -1));
  PictureOptions options = small(1);
  options.background = true;
  options.air = shade::test::clearAir(1000);
  const Pictures lit = sunnyPictures(asset, camera, options);
  options.air->shafts = shade::Shafts{};
  const Pictures shafts = sunnyPictures(asset, camera, options);
  EXPECT_LT(meanChange(lit.gl, shafts.gl), 1e-4);
  EXPECT_LT(meanChange(lit.cpu, shafts.cpu), 1e-4);
  // A Sun with sharp shadows is needed.
  const light::Environment sky = shade::test::sky();
  const auto without = picture(asset, sky.project(5), sky, camera, options);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().kind, ErrorKind::BadUsage);
}

/// Towers, a mirror and bumps, in units of a kilometre.
asset::Asset town() {
  asset::Asset asset;
  shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, 0, -1), 6.0f), {});
  for (int k = 0; k < 3; ++k)
    shade::test::addDiffuse(
        asset, box(Vec3(1.5f, 0.9f, 0.5f - 1.3f * float(k)), Vec3(0.2f, 0.9f, 0.4f)), {});
  shade::test::addMirror(asset, shade::test::sphere(Vec3(-0.8f, 0.5f, 0), 0.5f, 20),
                         Rgb(0.9f, 0.8f, 0.7f));
  shade::test::addPatched(asset, scene::translated(scene::uvSphere(0.4f, 24, 12), Vec3(0, 0.5f, 1)),
                          shade::test::bumpyRtt(16, 12, 4, 5), {});
  return asset;
}

// One renderer, while air, shafts, Sun, background and the object change: every frame as the CPU's.
TEST(GlAir, LiveFramesAreTheCpus) {
  const asset::Asset asset = town();
  const light::Environment sky = dayWithSun();
  auto context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  auto renderer = LiveRenderer::make(asset, {});
  ASSERT_TRUE(renderer) << renderer.error().message;
  PictureOptions options = small(2);
  ASSERT_TRUE(renderer->resize(options.width, options.height));
  ASSERT_TRUE(renderer->setEnvironment(sky));
  enum Air { None, Plain, Shafts };
  const struct {
    Air air;
    bool sun, background;
    double metres;
  } steps[] = {{None, true, true, 1000},   {Plain, true, true, 1000},  {Plain, true, false, 3000},
               {Shafts, true, true, 1000}, {Shafts, false, true, 500}, {Shafts, true, false, 500},
               {None, true, true, 1},      {Plain, true, true, 100}};
  for (std::size_t i = 0; i < std::size(steps); ++i) {
    LiveView view;
    view.camera = shade::test::cameraAt(Vec3(-0.3f, 0.3f, 4), Vec3(0, 0.9f, -1));
    view.background = options.background = steps[i].background;
    const Mat3 turn =
        Eigen::AngleAxisf(0.3f * float(i), Vec3(0.1f, 1, 0).normalized()).toRotationMatrix();
    view.worldFromAsset.topLeftCorner<3, 3>() = turn;
    view.worldFromAsset.topRightCorner<3, 1>() = Vec3(0.1f, 0.02f * float(i), 0);
    const Mat3 assetFromWorld = turn.transpose();
    const light::Environment turned = sky.rotated(assetFromWorld);
    options.sun.reset(), options.air.reset();
    if (steps[i].sun) options.sun = shade::sharpSunOf(turned, std::vector<double>(5, 1.0));
    if (steps[i].air != None) {
      options.air = shade::test::clearAir(steps[i].metres);
      options.air->sunFromAsset = turn.cast<double>();
      options.air->ground = -(assetFromWorld * view.worldFromAsset.topRightCorner<3, 1>());
      if (steps[i].air == Shafts) options.air->shafts.emplace();
    }
    ASSERT_TRUE(renderer->setSun(options.sun));
    ASSERT_TRUE(renderer->setAir(options.air));
    if (!options.sun && options.air) options.air->shafts.reset();
    const sh::RgbCoefficients light = turned.project(5);
    renderer->setLight(light);
    renderer->begin();
    for (const Vec2& place : scene::subpixelPositions(options.samples))
      ASSERT_TRUE(renderer->add(view, place, options.samples));
    auto gl = renderer->picture();
    ASSERT_TRUE(gl) << gl.error().message;
    scene::Camera camera = view.camera;
    camera.worldFromCamera = Mat4(view.worldFromAsset.inverse()) * camera.worldFromCamera;
    auto cpu = reference::relitPicture(asset, light, turned, camera, options);
    ASSERT_TRUE(cpu) << cpu.error().message;
    for (Image* image : {&*cpu, &*gl})
      for (Rgb& pixel : image->pixels) pixel /= kDay;
    test::expectSame("live-air-" + std::to_string(i), *cpu, *gl, {.mean = 0.25, .interior = 8});
  }
}

TEST(GlAir, OrthographicCamerasAreRefused) {
  const asset::Asset asset = longPlane(1, false);
  PictureOptions options = small(1);
  options.air = shade::test::clearAir();
  scene::Camera camera = cameraOver(1);
  camera.orthographicHalfHeight = 100.0f;
  const light::Environment sky = shade::test::sky();
  const auto gl = picture(asset, sky.project(5), sky, camera, options);
  ASSERT_FALSE(gl);
  EXPECT_EQ(gl.error().kind, ErrorKind::BadUsage);
}

}  // namespace
}  // namespace lambent::render
