// Captured light on the GPU against the same by rays, and against closed forms.
#include "lambent/render/gl_capture.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/capture/surroundings.h"
#include "lambent/light/environment.h"
#include "lambent/reference/capture_by_rays.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_target.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/rotation.h"

namespace lambent::render {
namespace {

using capture::Body;
using capture::CubeSize;
using capture::MovingScene;

/// √(Σ difference² / Σ b²) over all samples, coefficients and channels.
double relativeError(const std::vector<sh::RgbCoefficients>& a,
                     const std::vector<sh::RgbCoefficients>& b) {
  double error = 0, power = 0;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    EXPECT_EQ(a[k].values.size(), b[k].values.size());
    for (std::size_t i = 0; i < b[k].values.size(); ++i) {
      error += std::pow(double(a[k].values[i]) - double(b[k].values[i]), 2);
      power += std::pow(double(b[k].values[i]), 2);
    }
  }
  return std::sqrt(error / power);
}

Body ball(const Vec3& place, float radius, const Rgb& radiance) {
  Body body{"ball", scene::icosphere(radius, 4), radiance, {}};
  body.motion.place = place;
  return body;
}

Mat4 rigid(float radians, const Vec3& axis, const Vec3& move) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = Eigen::AngleAxisf(radians, axis.normalized()).toRotationMatrix();
  m.topRightCorner<3, 1>() = move;
  return m;
}

class GlCapture : public testing::Test {
 protected:
  void SetUp() override {
    Result<GlContext> made = GlContext::create();
    ASSERT_TRUE(made) << made.error().message;
    context_.emplace(std::move(*made));
  }
  static LightCapture make(const MovingScene& scene, const std::vector<Vec3>& points,
                           const CaptureOptions& options = {}) {
    Result<LightCapture> made = LightCapture::make(scene, points, options);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  static std::vector<sh::RgbCoefficients> capture(LightCapture& capture, double time,
                                                  const Mat4& worldFromAsset,
                                                  const sh::RgbCoefficients& light) {
    const Status done = capture.capture(time, worldFromAsset, light);
    EXPECT_TRUE(done) << done.error().message;
    auto read = capture.read();
    EXPECT_TRUE(read);
    return *read;
  }
  std::optional<GlContext> context_;
};

const std::vector<Vec3> kPoints = {{0, 0, 0},           {0.4f, 0.1f, -0.2f}, {-0.3f, 0.5f, 0.1f},
                                   {0.1f, -0.6f, 0.3f}, {-0.2f, 0, -0.7f},   {0.6f, 0.2f, 0.5f},
                                   {0, 0.7f, 0}};

// Every face, odd and even numbers of cubes, other sizes of maps, other bands; the environment's
// bands more and fewer than the capture's. GL moves vertices to the nearest 1/256 of a texel, so
// that a texel whose middle an edge all but meets may fall to the other side: most samples have
// none such and are equal to rounding, and none is far off.
TEST_F(GlCapture, EqualsTheSameByRays) {
  const MovingScene scene = capture::demoSurroundings({Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  const auto sky = light::Environment::disc(Vec3(0.3f, 1, 0.2f).normalized(), 0.8, Rgb(5, 4, 3));
  const Mat4 moved = rigid(0.7f, Vec3(1, 2, -1), Vec3(0.3f, -0.1f, 0.2f));
  struct Case {
    CubeSize cube;
    int bands, skyBands;
    std::size_t points;
  };
  for (const Case& c : {Case{{16, 2}, 5, 5, 7}, Case{{16, 2}, 5, 0, 1}, Case{{8, 1}, 3, 6, 3},
                        Case{{5, 3}, 10, 2, 6}}) {
    const std::vector<Vec3> points(kPoints.begin(), kPoints.begin() + std::ptrdiff_t(c.points));
    LightCapture onGpu = make(scene, points, {c.cube, c.bands, 0});
    std::vector<double> errors;
    const auto light = c.skyBands > 0 ? sky.project(c.skyBands) : sh::RgbCoefficients();
    for (const double time : {0.0, 3.7}) {
      const auto gl = capture(onGpu, time, moved, light);
      const auto rays =
          reference::captureByRays(scene, time, light, moved, points, c.bands, c.cube);
      for (std::size_t k = 0; k < points.size(); ++k) {
        errors.push_back(relativeError({gl[k]}, {rays[k]}));
        EXPECT_LT(errors.back(), 0.1)
            << c.cube.size << "², " << c.bands << " bands, time " << time << ", sample " << k;
      }
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 1e-6) << c.cube.size << "², " << c.bands << " bands";
  }
}

TEST_F(GlCapture, FacesOneByOneAreTheSame) {
  const MovingScene scene = capture::demoSurroundings({Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  const auto sky = light::Environment::uniform(Rgb(1, 2, 3)).project(5);
  LightCapture atOnce = make(scene, kPoints), oneByOne = make(scene, kPoints, {{}, 5, 1});
  const auto a = capture(atOnce, 1, Mat4::Identity(), sky);
  const auto b = capture(oneByOne, 1, Mat4::Identity(), sky);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].values, b[k].values);
}

// Seen from afar and from near, in all directions: the disc of half-angle asin(r/D).
TEST_F(GlCapture, ASphereIsADisc) {
  for (const Vec3& place : {Vec3(0, 6, 0), Vec3(-2, -1, 1.5f), Vec3(1, 0.2f, -3)}) {
    const float radius = 0.4f * place.norm();
    LightCapture onGpu = make({{ball(place, radius, Rgb(4, 2, 1))}}, {Vec3::Zero()});
    const auto exact =
        light::Environment::disc(place.normalized(), 2 * std::asin(0.4), Rgb(4, 2, 1)).project(5);
    EXPECT_LT(relativeError(capture(onGpu, 0, Mat4::Identity(), {}), {exact}), 0.02)
        << place.transpose();
  }
}

TEST_F(GlCapture, OccludersHideTheLampAndTheSky) {
  const auto sky = light::Environment::uniform(Rgb(2, 2, 2)).project(5);
  const Body lamp = ball(Vec3(0, 0, 9), 2, Rgb(5, 5, 5)),
             moon = ball(Vec3(0, 0, 3), 1, Rgb::Zero());
  // One sample behind the moon, one beside it.
  const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(6, 0, 9)};
  LightCapture both = make({{lamp, moon}}, points), moonOnly = make({{moon}}, points);
  const auto lit = capture(both, 0, Mat4::Identity(), sky);
  const auto dark = capture(moonOnly, 0, Mat4::Identity(), sky);
  EXPECT_LT(relativeError({lit[0]}, {dark[0]}), 1e-6);
  EXPECT_GT(lit[1].values[0], dark[1].values[0] + 0.1f);
  EXPECT_LT(dark[0].values[0], sky.values[0]);

  LightCapture alone = make({}, points);
  for (const auto& light : capture(alone, 0, Mat4::Identity(), sky))
    EXPECT_LT(relativeError({light}, {sky}), 1e-6);
}

TEST_F(GlCapture, ATurnedAssetSeesATurnedWorld) {
  const MovingScene scene{
      {ball(Vec3(3, 1, 0), 1.3f, Rgb(4, 2, 1)), ball(Vec3(-1, 3, 1), 1, Rgb(0.2f, 1, 3))}};
  const auto sky = light::Environment::clampedCosine(Vec3(0, 1, 0), Rgb(1, 1, 2)).project(5);
  const Mat4 moved = rigid(2.1f, Vec3(1, -2, 1), Vec3(0.2f, 0, -0.3f));
  const Mat3 rotation = moved.topLeftCorner<3, 3>();
  const Vec3 point(0.4f, 0, 0.2f);
  const Vec3 inWorld = rotation * point + Vec3(moved.topRightCorner<3, 1>());
  LightCapture asset = make(scene, {point}, {{32, 2}, 5, 0});
  LightCapture world = make(scene, {inWorld}, {{32, 2}, 5, 0});
  const auto expected = capture(world, 0, Mat4::Identity(), sky);
  EXPECT_LT(
      relativeError(capture(asset, 0, moved, sky), {sh::rotate(rotation.transpose(), expected[0])}),
      0.01);
}

TEST_F(GlCapture, LeavesStateAsItWas) {
  LightCapture onGpu = make({{ball(Vec3(0, 0, 3), 1, Rgb::Ones())}}, {Vec3::Zero()});
  Result<GlTarget> target = GlTarget::make(7, 5);
  ASSERT_TRUE(target);
  glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
  glViewport(1, 2, 3, 4);
  glEnable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);  // which would spoil the clearing
  glScissor(0, 0, 1, 1);
  glColorMask(GL_FALSE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_GREATER);
  glCullFace(GL_FRONT_AND_BACK);
  glEnable(GL_CLIP_DISTANCE2);
  const Program::Stage stage{
      GL_COMPUTE_SHADER, "nothing", {"layout(local_size_x = 1) in; void main() {}"}};
  const Result<Program> program = Program::make({&stage, 1});
  ASSERT_TRUE(program) << program.error().message;
  program->use();
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  const VertexArray array(name);
  glBindVertexArray(name);
  const auto of = [](GLenum which) {
    GLint value = 0;
    glGetIntegerv(which, &value);
    return value;
  };
  const GLint used = of(GL_CURRENT_PROGRAM);
  ASSERT_NE(used, 0);
  const auto before = capture(onGpu, 0, Mat4::Identity(), {});
  EXPECT_NEAR(before[0].values[0], std::sqrt(kPi) * (1 - std::cos(std::asin(1 / 3.0))), 1e-2);
  GLint viewport[4], framebuffer = 0, function = 0;
  glGetIntegerv(GL_VIEWPORT, viewport);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glGetIntegerv(GL_DEPTH_FUNC, &function);
  EXPECT_EQ(viewport[1], 2);
  EXPECT_EQ(GLuint(framebuffer), target->framebuffer());
  EXPECT_EQ(function, GL_GREATER);
  EXPECT_TRUE(glIsEnabled(GL_BLEND));
  EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST));
  EXPECT_FALSE(glIsEnabled(GL_CLIP_DISTANCE0));
  EXPECT_TRUE(glIsEnabled(GL_CLIP_DISTANCE2));
  EXPECT_EQ(of(GL_CULL_FACE_MODE), GL_FRONT_AND_BACK);
  EXPECT_EQ(of(GL_CURRENT_PROGRAM), used);
  EXPECT_EQ(of(GL_VERTEX_ARRAY_BINDING), GLint(name));
  glDisable(GL_CLIP_DISTANCE2);
  glCullFace(GL_BACK);
}

TEST_F(GlCapture, KnowsWhereBodiesAre) {
  const MovingScene scene = capture::demoSurroundings({Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  const LightCapture onGpu = make(scene, {Vec3::Zero()});
  for (const double time : {0.0, 3.0}) {
    const scene::Box exact = scene::bounds(capture::frozen(scene, time));
    const scene::Box box = onGpu.bounds(time);
    EXPECT_TRUE((box.lower.array() <= exact.lower.array() + 1e-5f).all());
    EXPECT_TRUE((box.upper.array() >= exact.upper.array() - 1e-5f).all());
    EXPECT_LT(box.diagonal(), 2 * exact.diagonal());
  }
}

TEST_F(GlCapture, RefusesMoreThanATextureHolds) {
  const std::vector<Vec3> points(100000, Vec3::Zero());
  const Result<LightCapture> made = LightCapture::make({}, points, {{64, 2}, 5, 0});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("fewer points"), std::string::npos) << made.error().message;
}

// Bodies in a picture: their colour, their backs, and what stands before what.
TEST_F(GlCapture, DrawsTheBodiesWithDepth) {
  scene::Camera camera;
  camera.orthographicHalfHeight = 1.0f;
  camera.worldFromCamera(2, 3) = 5;
  const scene::Box asset{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  const Mat4 clip = scene::clipFromWorld(camera, 8, 8, asset);
  Result<GlTarget> target = GlTarget::make(8, 8);
  ASSERT_TRUE(target);
  const auto middle = [&](const MovingScene& scene) {
    LightCapture capture = make(scene, {Vec3::Zero()});
    target->beginFrame();
    target->clearSum();
    capture.draw(target->framebuffer(), 8, 8, clip, 0);
    target->addToSum({}, {});
    const Result<image::Image> image = target->mean(1);
    EXPECT_TRUE(image);
    return image->at(4, 4);
  };
  const Body red = ball(Vec3(0, 0, 0), 0.5f, Rgb(3, 0, 0));
  const Body green = ball(Vec3(0, 0, 0.8f), 0.5f, Rgb(0, 2, 0));
  EXPECT_TRUE(middle({{red, green}}).isApprox(Rgb(0, 2, 0)));
  EXPECT_TRUE(middle({{green, red}}).isApprox(Rgb(0, 2, 0)));
  // Beyond the planes that were fitted to the asset: still there, and in the right sequence.
  const Body far = ball(Vec3(0, 0, -30), 2, Rgb(0, 0, 7)),
             near = ball(Vec3(0, 0, 3.5f), 1, Rgb::Ones());
  EXPECT_TRUE(middle({{far}}).isApprox(Rgb(0, 0, 7)));
  EXPECT_TRUE(middle({{far, red}}).isApprox(Rgb(3, 0, 0)));
  EXPECT_TRUE(middle({{red, far}}).isApprox(Rgb(3, 0, 0)));
  EXPECT_TRUE(middle({{near, red, far}}).isApprox(Rgb::Ones()));
  // One body of two parts that are both beyond.
  Body parts = far;
  parts.mesh = scene::merge(
      std::vector{scene::icosphere(0.4f, 3),
                  scene::translated(scene::flipped(scene::icosphere(0.4f, 3)), Vec3(0, 0, -9))});
  EXPECT_TRUE(middle({{parts}}).isApprox(Rgb(0, 0, 7)));
  Body back = red;
  back.mesh = scene::flipped(back.mesh);
  EXPECT_TRUE((middle({{back}}) == 0).all());
  EXPECT_TRUE((middle({{back, far}}) == 0).all());
}

}  // namespace
}  // namespace lambent::render
