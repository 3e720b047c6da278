#include "lambent/reference/capture_by_rays.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/light/environment.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/zonal.h"

namespace lambent::reference {
namespace {

using namespace capture;  // NOLINT: the room whose oracle this is

constexpr int kBands = 5;

Body ball(const Vec3& place, float radius, const Rgb& radiance) {
  Body body{"ball", scene::icosphere(radius, 4), radiance, {}};
  body.motion.place = place;
  return body;
}

double relativeError(const sh::RgbCoefficients& a, const sh::RgbCoefficients& b) {
  double error = 0, power = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    error += std::pow(double(a.values[i]) - double(b.values[i]), 2);
    power += std::pow(double(b.values[i]), 2);
  }
  return std::sqrt(error / power);
}

std::vector<sh::RgbCoefficients> capture(const MovingScene& scene, const sh::RgbCoefficients& light,
                                         const Mat4& worldFromAsset,
                                         const std::vector<Vec3>& points,
                                         const CubeSize& shape = {}) {
  return captureByRays(scene, 0, light, worldFromAsset, points, kBands, shape);
}

// A sphere of constant radiance looks like a disc of half-angle asin(r/D).
TEST(CaptureByRays, ASphereIsADisc) {
  const MovingScene scene{{ball(Vec3(3, 1, -2), 1.2f, Rgb(4, 2, 1))}};
  const Vec3 point(0.5f, 0.5f, 0);
  const Vec3 way = Vec3(3, 1, -2) - point;
  const auto exact =
      light::Environment::disc(way.normalized(), 2 * std::asin(1.2f / way.norm()), Rgb(4, 2, 1))
          .project(kBands);
  const auto captured = capture(scene, {}, Mat4::Identity(), {point});
  EXPECT_LT(relativeError(captured[0], exact), 0.02);
}

TEST(CaptureByRays, WithoutBodiesIsTheEnvironmentExactly) {
  const auto world = light::Environment::disc(Vec3(0, 1, 0), 0.3, Rgb(9, 8, 7)).project(8);
  Mat4 turned = Mat4::Identity();
  turned.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(1.1f, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto captured = capture({}, world, turned, {Vec3(0, 0, 0), Vec3(9, 9, 9)});
  const auto expected =
      sh::withBands(sh::rotate(turned.topLeftCorner<3, 3>().transpose(), world), kBands);
  for (const auto& light : captured) EXPECT_LT(relativeError(light, expected), 1e-6);
}

// A black ball about the point hides everything; a black disc in front of a uniform sky takes its
// own coefficients away.
TEST(CaptureByRays, OccludersHideTheEnvironment) {
  const auto sky = light::Environment::uniform(Rgb(2, 2, 2)).project(kBands);
  const MovingScene room{{Body{"room", scene::room(Vec3(2, 2, 2)), Rgb::Zero(), {}}}};
  const auto dark = capture(room, sky, Mat4::Identity(), {Vec3(0.2f, 0, 0)});
  for (const float value : dark[0].values) EXPECT_NEAR(value, 0, 1e-2 * sky.values[0]);

  const MovingScene moon{{ball(Vec3(0, 0, 4), 1.5f, Rgb::Zero())}};
  auto expected = sky;
  const auto hidden = light::Environment::disc(Vec3(0, 0, 1), 2 * std::asin(1.5f / 4), Rgb(2, 2, 2))
                          .project(kBands);
  for (std::size_t i = 0; i < expected.values.size(); ++i) expected.values[i] -= hidden.values[i];
  const auto captured = capture(moon, sky, Mat4::Identity(), {Vec3::Zero()});
  EXPECT_LT(relativeError(captured[0], expected), 0.01);
}

TEST(CaptureByRays, NearBodiesHideFarOnesAndBacksAreBlack) {
  const MovingScene scene{{ball(Vec3(0, 0, 9), 2, Rgb(5, 5, 5)),
                           ball(Vec3(0, 0, 3), 1, Rgb::Zero()),
                           Body{"inside out",
                                scene::flipped(scene::icosphere(1, 3)),
                                Rgb(7, 7, 7),
                                {{}, Vec3(0, 5, 0), {}, {}}}}};
  const auto captured = capture(scene, {}, Mat4::Identity(), {Vec3::Zero()});
  for (const float value : captured[0].values) EXPECT_NEAR(value, 0, 1e-6);
}

// Turning the asset turns the coefficients the other way; the rest is the cubes' own error.
TEST(CaptureByRays, ATurnedAssetSeesATurnedWorld) {
  const MovingScene scene{
      {ball(Vec3(3, 1, 0), 1.3f, Rgb(4, 2, 1)), ball(Vec3(-1, 3, 1), 1, Rgb(0.2f, 1, 3))}};
  const auto sky = light::Environment::clampedCosine(Vec3(0, 1, 0), Rgb(1, 1, 2)).project(kBands);
  const Mat3 rotation = Eigen::AngleAxisf(0.8f, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  Mat4 moved = Mat4::Identity();
  moved.topLeftCorner<3, 3>() = rotation;
  moved.topRightCorner<3, 1>() = Vec3(0.1f, 0.2f, -0.3f);
  const Vec3 point(0.4f, 0, 0.2f);
  const Vec3 inWorld = rotation * point + Vec3(0.1f, 0.2f, -0.3f);
  const auto world = capture(scene, sky, Mat4::Identity(), {inWorld}, {32, 2});
  const auto asset = capture(scene, sky, moved, {point}, {32, 2});
  EXPECT_LT(relativeError(asset[0], sh::rotate(rotation.transpose(), world[0])), 0.01);
}

}  // namespace
}  // namespace lambent::reference
