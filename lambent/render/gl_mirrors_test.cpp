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
#include "lambent/render/gl_picture_in_blocks.h"
#include "lambent/render/live_renderer.h"
#include "lambent/render/test_agreement.h"
#include "lambent/scene/shapes.h"
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
constexpr std::size_t kLargestBlockOfTests = std::size_t(1) << 27;
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
  std::vector<bool> mirror;  ///< pixels that show one
};

MirrorPictures mirrorPictures(const std::string& name, const asset::Asset& asset,
                              const scene::Camera& camera, const PictureOptions& options,
                              const light::Environment& environment = shade::test::sky()) {
  const sh::RgbCoefficients light = environment.project(5);
  auto cpu = reference::relitPicture(asset, light, environment, camera, options);
  auto gl = pictureInBlocks(asset, light, environment, camera, options, kLargestBlockOfTests);
  if (!cpu || !gl) {
    ADD_FAILURE() << (cpu ? gl.error().message : cpu.error().message);
    return {};
  }
  if (const char* directory = std::getenv("LAMBENT_TEST_PICTURES")) {
    for (const auto& [image, way] : {std::pair{&*cpu, "-cpu.png"}, {&*gl, "-gl.png"}})
      EXPECT_TRUE(image::write(tone::toneMap(*image, 0.0f, tone::Curve::Filmic),
                               std::filesystem::path(directory) / (name + way)));
  }
  return {std::move(*cpu), std::move(*gl), test::mirrorsIn(asset, camera, options)};
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

void expectClose(const std::string& name, const MirrorPictures& pictures, double rmse,
                 double bias = 0.01) {
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
  for (const auto& [eye, name] :
       {std::pair{Vec3(2, 2, 5), "plane-right"}, {Vec3(-1, 1, 3), "plane-near"}})
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3(0, 0.7f, -1)), small(4)),
                0.12);
}

// A wrong hand or a face turned over would show another wall.
TEST(GlMirrors, ABallInARoom) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(0.2f, -0.1f, 0.1f), 0.5f, 48), kSilver);
  shade::test::addDiffuse(asset, scene::room(Vec3(5, 3, 4), 16), kColoured);
  for (const Vec3& eye : {Vec3(1.4f, 0.5f, 1.4f), Vec3(-1.4f, -0.9f, -1.2f)}) {
    const std::string name = "ball-in-a-room-" + std::to_string(eye.x() > 0);
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3(0.2f, -0.1f, 0.1f)), small(4)),
                0.03);
  }
}

TEST(GlMirrors, ABox) {
  asset::Asset asset;
  shade::test::addMirror(
      asset, scene::rotated(scene::box(Vec3(1.4f, 1.2f, 1)), Vec3::UnitY(), 0.4f), kSilver);
  addThings(asset, 1.9f);
  shade::test::addDiffuse(asset, groundAt(-0.7f, 6), kColoured);
  for (const Vec3& eye : {Vec3(2.5f, 2.0f, 3.5f), Vec3(-2.5f, 0.8f, -2.5f)}) {
    const std::string name = "box-" + std::to_string(eye.x() > 0);
    expectClose(name, mirrorPictures(name, asset, cameraAt(eye, Vec3::Zero()), small(4)), 0.1);
  }
}

// What one mirror shows of another is as it is seen from its middle: highlights lie beside where
// rays have them.
TEST(GlMirrors, ShowEachOther) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(-0.8f, 0, 0), 0.7f, 48), kSilver);
  shade::test::addMirror(asset, shade::test::sphere(Vec3(0.8f, 0, 0), 0.7f, 48), kSilver);
  shade::test::addDiffuse(asset, groundAt(-0.8f, 6), kColoured);
  expectClose("two",
              mirrorPictures("two", asset, cameraAt(Vec3(0, 1.5f, 4), Vec3::Zero()), small(4)), 0.3,
              0.02);
}

TEST(GlMirrors, MoreThanHaveMapsOfTheirOwn) {
  asset::Asset asset;
  for (int k = 0; k < 10; ++k) {
    const Vec3 center(0.5f * float(k) - 2.2f, 0, 0.2f * float(k % 3));
    shade::test::addMirror(asset, shade::test::sphere(center, 0.2f + 0.003f * float(k), 16),
                           kSilver);
  }
  shade::test::addDiffuse(asset, groundAt(-0.3f, 6), kColoured);
  expectClose("many",
              mirrorPictures("many", asset, cameraAt(Vec3(0, 1.5f, 4), Vec3::Zero()), small(4)),
              0.2, 0.03);
}

/// In place of the middle of its box, where a body is: a ring around it is not black.
TEST(GlMirrors, GoAroundWhatStandsInTheirMiddle) {
  asset::Asset asset;
  shade::test::addMirror(asset, scene::ring(1.2f, 1.3f, 0.6f, 96), kSilver);
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3::Zero(), 0.6f, 24), kColoured);
  shade::test::addDiffuse(asset, groundAt(-0.7f, 6), kColoured);
  const MirrorPictures pictures =
      mirrorPictures("ring", asset, cameraAt(Vec3(0, 2.5f, 3), Vec3::Zero()), small(4));
  expectClose("ring", pictures, 0.45, 0.1);
}

/// Of a ball over a ground, beside a plane mirror.
asset::Asset ballBesideAMirror() {
  asset::Asset asset;
  shade::test::addMirror(
      asset,
      scene::translated(scene::rotated(scene::gridPlane(3, 2, 1, 1), Vec3::UnitX(), float(kPi / 2)),
                        Vec3(0, 0.5f, -1.2f)),
      kSilver);
  shade::test::addDiffuse(asset, shade::test::sphere(Vec3(0.5f, 0.2f, 0), 0.6f, 24), kColoured);
  shade::test::addDiffuse(asset, groundAt(-0.5f, 4), kColoured);
  return asset;
}

const scene::Camera kBeside = cameraAt(Vec3(-1.5f, 1.5f, 3.5f), Vec3(0, 0.3f, -1));

TEST(GlMirrors, InAir) {
  PictureOptions options = small(2);
  const MirrorPictures without =
      mirrorPictures("without-air", ballBesideAMirror(), kBeside, options);
  options.air = shade::test::clearAir(2000);
  const MirrorPictures with = mirrorPictures("in-air", ballBesideAMirror(), kBeside, options);
  expectClose("in-air", with, 0.03);
  EXPECT_GT(std::abs(mirrorError({without.cpu, with.gl, with.mirror}).bias), 0.05);
}

/// Shadows in what mirrors show lie where a single point of the Sun throws them.
TEST(GlMirrors, UnderASharpSun) {
  asset::Asset asset = ballBesideAMirror();
  for (transfer::EncodedMesh& mesh : asset.transfer.meshes) {
    auto* surface = std::get_if<transfer::Surface<transfer::Numbers>>(&mesh);
    if (!surface) continue;
    auto held = *surface->responses.find(*surface->responses.most());
    surface->responses.drop(*surface->responses.most());
    surface->responses.set(transfer::Kind::Shadowed, std::move(held));
  }
  asset.transfer.kind = transfer::Kind::Shadowed;
  const light::Environment light =
      light::Environment::uniform(Rgb(0.2f, 0.3f, 0.5f)) +
      light::Environment::disc({.direction = Vec3(0.6f, 0.6f, 0.53f).normalized(),
                                .angularDiameter = 0.0093,
                                .irradiance = Rgb(4.0f, 3.6f, 3.0f)});
  PictureOptions options = small(4);
  options.sun = shade::sharpSunOf(light, std::vector<double>(5, 1.0));
  ASSERT_TRUE(options.sun);
  const MirrorPictures sharp = mirrorPictures("under-the-sun", asset, kBeside, options, light);
  expectClose("under-the-sun", sharp, 0.2);
  options.sun.reset();
  const MirrorPictures soft = mirrorPictures("soft-sun", asset, kBeside, options, light);
  EXPECT_GT(mirrorError({soft.cpu, sharp.gl, sharp.mirror}).rmse, 0.2);
}

/// The environment is part of what a pane lets through, in the mean.
TEST(GlMirrors, ShowVeilsByTheirShare) {
  asset::Asset asset = ballBesideAMirror();
  asset.scene.materials[1].transmitted = Rgb::Constant(0.5f);
  PictureOptions options = small(16);
  const MirrorPictures pictures = mirrorPictures("veil", asset, kBeside, options);
  expectClose("veil", pictures, 0.2, 0.02);
}

TEST(GlMirrors, ShowMesoStructure) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3(0, 0, 0), 0.6f, 48), kSilver);
  shade::test::addPatched(asset, scene::translated(scene::gridPlane(4, 4, 8, 8), Vec3(0, -0.8f, 0)),
                          shade::test::bumpyRtt(16, 16, 8, 5), {});
  const MirrorPictures pictures =
      mirrorPictures("patch", asset, cameraAt(Vec3(1, 1, 3), Vec3::Zero()), small(4));
  expectClose("patch", pictures, 0.05);
}

/// How many triangles a frame has drawn, and cube maps there are.
class Frames {
 public:
  explicit Frames(LiveRenderer& renderer) : renderer_(renderer) { glGenQueries(1, &query_); }
  ~Frames() { glDeleteQueries(1, &query_); }
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  int trianglesOf(const LiveView& view) {
    renderer_.begin();
    glBeginQuery(GL_PRIMITIVES_GENERATED, query_);
    EXPECT_TRUE(renderer_.add(view));
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLint count = 0;
    glGetQueryObjectiv(query_, GL_QUERY_RESULT, &count);
    return count;
  }

 private:
  LiveRenderer& renderer_;
  GLuint query_ = 0;
};

long cubesAlive() {
  long count = 0;
  for (GLuint name = 1; name < 2000; ++name) {
    GLint target = 0;
    if (!glIsTexture(name)) continue;
    glGetTextureParameteriv(name, GL_TEXTURE_TARGET, &target);
    count += target == GL_TEXTURE_CUBE_MAP;
  }
  return count;
}

Mat4 turnedBy(float angle) {
  Mat4 matrix = Mat4::Identity();
  matrix.topLeftCorner<3, 3>() = Eigen::AngleAxisf(angle, Vec3::UnitY()).toRotationMatrix();
  return matrix;
}

TEST(GlMirrors, AreCapturedWhenTheLightChangesAndNotTheCamera) {
  const auto context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const light::Environment sky = shade::test::sky();
  for (const int mirrors : {1, 2}) {
    asset::Asset asset;
    for (int k = 0; k < mirrors; ++k)
      shade::test::addMirror(asset, shade::test::sphere(Vec3(2.0f * float(k), 0, 0), 0.5f, 4),
                             kSilver);
    shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, -1, 0), 3), {});
    const int mirror = int(asset.scene.meshes[0].triangles.size()), floor = 2;
    const int all = mirrors * mirror + floor;
    const int captured = mirrors == 1 ? 6 * floor : 2 * 2 * 6 * (mirror + floor);
    auto live = LiveRenderer::make(asset, {}, kLargestBlockOfTests);
    ASSERT_TRUE(live) << live.error().message;
    ASSERT_TRUE(live->resize(16, 16));
    ASSERT_TRUE(live->setEnvironment(sky));
    live->setLight(sky.project(5));
    Frames frames(*live);
    LiveView view;
    view.camera = cameraAt(Vec3(0, 2, 5), Vec3::Zero());
    EXPECT_EQ(cubesAlive(), 0);
    EXPECT_EQ(frames.trianglesOf(view), all + captured);
    EXPECT_EQ(cubesAlive(), mirrors);
    EXPECT_EQ(frames.trianglesOf(view), all);
    view.camera = cameraAt(Vec3(3, 1, 4), Vec3::Zero());
    EXPECT_EQ(frames.trianglesOf(view), all);
    view.worldFromAsset.topRightCorner<3, 1>() = Vec3(0.1f, 0, 0);
    EXPECT_EQ(frames.trianglesOf(view), all);
    live->setLight(sky.project(4));
    EXPECT_EQ(frames.trianglesOf(view), all + captured);
    EXPECT_EQ(frames.trianglesOf(view), all);
    ASSERT_TRUE(live->choose(shade::Showing::of(transfer::Kind::Unshadowed)));
    EXPECT_EQ(frames.trianglesOf(view), all + captured);
    // Mirrors in what mirrors show have an environment around them.
    const int ofEnvironment = mirrors == 1 ? 0 : captured;
    view.worldFromAsset = turnedBy(0.5f);
    EXPECT_EQ(frames.trianglesOf(view), all + ofEnvironment);
    ASSERT_TRUE(live->setEnvironment(sky));
    EXPECT_EQ(frames.trianglesOf(view), all + ofEnvironment);
    EXPECT_EQ(frames.trianglesOf(view), all);
    live->setLight(sky.project(5));
    view.unlit = true;
    EXPECT_EQ(frames.trianglesOf(view), all);
    view.unlit = false;
    EXPECT_EQ(frames.trianglesOf(view), all + captured);
  }
}

TEST(GlMirrors, CostNothingWhereThereIsNoneOrNothingElse) {
  const auto context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  const light::Environment sky = shade::test::sky();
  for (const bool mirror : {false, true}) {
    asset::Asset asset;
    const scene::Mesh ball = shade::test::sphere(Vec3::Zero(), 1, 8);
    if (mirror)
      shade::test::addMirror(asset, ball, kSilver);
    else
      shade::test::addDiffuse(asset, ball, {});
    auto live = LiveRenderer::make(asset, {}, kLargestBlockOfTests);
    ASSERT_TRUE(live) << live.error().message;
    ASSERT_TRUE(live->resize(16, 16));
    live->setLight(sky.project(5));
    Frames frames(*live);
    LiveView view;
    view.camera = cameraAt(Vec3(0, 2, 5), Vec3::Zero());
    EXPECT_EQ(frames.trianglesOf(view), int(ball.triangles.size()));
    EXPECT_EQ(cubesAlive(), 0);
  }
}

}  // namespace
}  // namespace lambent::render
