// Mirrors that show the asset they belong to: OpenGL's captures against rays.

#include "lambent/render/gl_mirrors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <Eigen/Geometry>

#include "lambent/image/io.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_picture.h"
#include "lambent/render/live_renderer.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/shade/test_air.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::render {
namespace {

using image::Image;
using shade::PictureOptions;
using shade::test::cameraAt;
using test::small;
using transfer::Encoding;

const shade::test::DiffuseOptions kColoured{5, 3, Encoding::Float32, false};
const Rgb kSilver(0.9f, 0.8f, 0.7f);

/// What stands around a mirror: a body on every side of it, each of other colours.
void addThings(asset::Asset& asset, float reach) {
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(reach, 0.2f, 0.3f), 0.7f, 24), kColoured);
  shade::test::addDiffuse(
      asset, scene::translated(scene::box(Vec3(0.5f, 2.0f, 0.8f), 6), Vec3(-reach, 0.3f, 0.6f)),
      kColoured);
  shade::test::addDiffuse(
      asset, scene::translated(scene::box(Vec3(1.2f, 0.6f, 0.4f), 6), Vec3(0.1f, 0.3f, reach)),
      kColoured);
  shade::test::addDiffuse(
      asset, scene::translated(scene::torus(0.6f, 0.2f, 24, 12), Vec3(0.2f, reach, 0)), kColoured);
}

/// A floor of many small triangles, coloured by place.
scene::Mesh groundAt(float height, float side) {
  return scene::translated(scene::gridPlane(side, side, 24, 24), Vec3(0, height, 0));
}

struct MirrorPictures {
  Image cpu, gl;
  std::vector<bool> mirror;  ///< pixels that show one and nothing else
};

MirrorPictures mirrorPictures(const std::string& name, const asset::Asset& asset,
                    const scene::Camera& camera, const PictureOptions& options,
                    const light::Environment& environment = shade::test::sky()) {
  const sh::RgbCoefficients light = environment.project(5);
  auto cpu = reference::relitPicture(asset, light, environment, camera, options);
  auto gl = picture(asset, light, environment, camera, options);
  if (!cpu || !gl) {
    ADD_FAILURE() << (cpu ? gl.error().message : cpu.error().message);
    return {};
  }
  if (const char* directory = std::getenv("LAMBENT_TEST_PICTURES"))
    for (const auto& [image, way] : {std::pair{&*cpu, "-cpu.png"}, {&*gl, "-gl.png"}})
      EXPECT_TRUE(image::write(tone::toneMap(*image, 0.0f, tone::Curve::Filmic),
                               std::filesystem::path(directory) / (name + way)));
  // Where every sub-sample shows a mirror, nothing is left of the light if they are black, and nothing
  // else than light is taken away.
  MirrorPictures result{std::move(*cpu), std::move(*gl), {}};
  asset::Asset black = asset;
  for (scene::Material& material : black.scene.materials)
    if (material.isMirror()) material.mirror = Rgb(1e-6f, 0, 0);
  PictureOptions dark = options;
  dark.sun.reset();
  dark.air.reset();
  const auto without = reference::relitPicture(
      black, light::Environment::uniform(Rgb::Ones()).project(5), {}, camera, dark);
  for (std::size_t i = 0; i < without->pixels.size(); ++i)
    result.mirror.push_back(without->alpha[i] == 1.0f && without->pixels[i].maxCoeff() < 1e-4f);
  return result;
}

struct MirrorError {
  double rmse = 0;  ///< of mirrors' pixels, over their mean
  double bias = 0;  ///< of their mean
};

MirrorError mirrorError(const MirrorPictures& pictures) {
  double squares = 0, sum = 0, drawn = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pictures.mirror.size(); ++i) {
    if (!pictures.mirror[i]) continue;
    ++count;
    squares += double((pictures.gl.pixels[i] - pictures.cpu.pixels[i]).square().mean());
    sum += double(pictures.cpu.pixels[i].mean());
    drawn += double(pictures.gl.pixels[i].mean());
  }
  EXPECT_GT(count, 300u);
  return {std::sqrt(squares / double(count)) / (sum / double(count)), drawn / sum - 1};
}

void expectClose(const std::string& name, const MirrorPictures& pictures, double rmse, double bias = 0.01) {
  const MirrorError error = mirrorError(pictures);
  testing::Test::RecordProperty(name + "-rmse", std::to_string(error.rmse));
  testing::Test::RecordProperty(name + "-bias", std::to_string(error.bias));
  EXPECT_LT(error.rmse, rmse) << name;
  EXPECT_LT(std::abs(error.bias), bias) << name;
}

TEST(GlMirrors, APlaneOne) {
  asset::Asset asset;
  shade::test::addMirror(
      asset,
      scene::translated(scene::rotated(scene::gridPlane(4, 4, 1, 1), Vec3::UnitX(), float(kPi / 2)),
                        Vec3(0, 1, -1)),
      kSilver);
  addThings(asset, 1.5f);
  shade::test::addDiffuse(asset, groundAt(-1, 6), kColoured);
  for (const auto& [eye, name] : {std::pair{Vec3(2, 2, 5), "plane-right"}, {Vec3(-1, 1, 3), "plane-near"}})
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3(0, 0.7f, -1)), small(4)), 0.2);
}

// A wrong hand or a face turned over would show another wall.
TEST(GlMirrors, ABallInARoom) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(0.2f, -0.1f, 0.1f), 0.5f, 48), kSilver);
  shade::test::addDiffuse(asset, scene::room(Vec3(5, 3, 4), 16), kColoured);
  for (const Vec3& eye : {Vec3(1.4f, 0.5f, 1.4f), Vec3(-1.4f, -0.9f, -1.2f)}) {
    const std::string name = "ball-in-a-room-" + std::to_string(eye.x() > 0);
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3(0.2f, -0.1f, 0.1f)), small(4)), 0.03);
  }
}

TEST(GlMirrors, ABox) {
  asset::Asset asset;
  shade::test::addMirror(asset, scene::rotated(scene::box(Vec3(1.4f, 1.2f, 1)), Vec3::UnitY(), 0.4f),
                         kSilver);
  addThings(asset, 1.9f);
  shade::test::addDiffuse(asset, groundAt(-0.7f, 6), kColoured);
  for (const Vec3& eye : {Vec3(2.5f, 2.0f, 3.5f), Vec3(-2.5f, 0.8f, -2.5f)}) {
    const std::string name = "box-" + std::to_string(eye.x() > 0);
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3::Zero()), small(4)), 0.2);
  }
}

TEST(GlMirrors, ShowEachOther) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(-0.8f, 0, 0), 0.7f, 48), kSilver);
  shade::test::addMirror(asset, shade::test::sphere(Vec3(0.8f, 0, 0), 0.7f, 48), kSilver);
  shade::test::addDiffuse(asset, groundAt(-0.8f, 6), kColoured);
  expectClose("two", mirrorPictures("two", asset, cameraAt(Vec3(0, 1.5f, 4), Vec3::Zero()), small(4)), 0.1);
}

TEST(GlMirrors, MoreThanHaveMapsOfTheirOwn) {
  asset::Asset asset;
  for (int k = 0; k < 11; ++k)
    shade::test::addMirror(
        asset, shade::test::sphere(Vec3(0.5f * float(k) - 2.5f, 0, 0.2f * float(k % 3)), 0.2f + 0.003f * float(k), 24),
        kSilver);
  shade::test::addDiffuse(asset, groundAt(-0.3f, 6), kColoured);
  expectClose("many", mirrorPictures("many", asset, cameraAt(Vec3(0, 1.5f, 4), Vec3::Zero()), small(4)), 0.15, 0.03);
}

/// In place of the middle of its box, where a body is: a ring around it is not black.
TEST(GlMirrors, GoAroundWhatStandsInTheirMiddle) {
  asset::Asset asset;
  shade::test::addMirror(asset, scene::ring(1.2f, 1.3f, 0.6f, 96), kSilver);
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 0.6f, 24), kColoured);
  shade::test::addDiffuse(asset, groundAt(-0.7f, 6), kColoured);
  const MirrorPictures pictures =
      mirrorPictures("ring", asset, cameraAt(Vec3(0, 2.5f, 3), Vec3::Zero()), small(4));
  expectClose("ring", pictures, 0.5, 0.25);
}

}  // namespace
}  // namespace lambent::render
