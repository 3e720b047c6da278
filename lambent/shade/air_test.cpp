#include "lambent/shade/air.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/shade/picture_frame.h"
#include "lambent/shade/test_air.h"
#include "lambent/sky/aerial_table.h"

namespace lambent::shade {
namespace {

const Rgb kSent(3.0f, 2.0f, 1.0f);

Vec3 lookAlong(double elevation, double azimuth) {
  return Vec3d(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
               std::cos(elevation) * std::sin(azimuth))
      .cast<float>();
}

TEST(Air, ChangesNothingAtNoDistance) {
  const Air air = test::clearAir();
  for (const double elevation : {-1.2, -0.1, 0.0, 0.3, 1.5}) {
    const Vec3 direction = lookAlong(elevation, 0.4);
    EXPECT_TRUE((air.seen(direction, 0.0f, kSent) == kSent).all());
    EXPECT_LT((air.seen(direction, 0.1f, kSent) - kSent).abs().maxCoeff(), 1e-3f) << elevation;
  }
}

TEST(Air, FarAwayIsTheSky) {
  const Air air = test::clearAir();
  for (const double elevation : {0.001, 0.02, 0.4})
    for (const double azimuth : {0.3, 1.9, -2.8}) {
      const Vec3 direction = lookAlong(elevation, azimuth);
      // Beyond the top of the air nothing is added: the sky, and what is left of the light.
      const Rgb sky = air.seen(direction, 3e6f, Rgb::Zero());
      EXPECT_GT(sky.minCoeff(), 0.0f);
      EXPECT_TRUE((air.seen(direction, 3e7f, Rgb::Zero()) == sky).all());
      // Little is left of anything at the horizon.
      const Rgb left = air.seen(direction, 3e6f, Rgb::Ones()) - sky;
      EXPECT_LT(left.maxCoeff(), elevation < 0.01 ? 0.1f : 1.0f);
      EXPECT_GT(left.minCoeff(), -1e-5f);
    }
}

TEST(Air, LiesBeforeTheGroundOfAnEnvironment) {
  const Air air = test::clearAir();
  const Rgb ground(2.0f, 1.0f, 0.5f);
  const Vec3 from = Vec3::Zero();
  for (const double elevation : {0.0, 0.3, 1.5})
    EXPECT_TRUE((air.seenBehind(from, lookAlong(elevation, 1.0), ground) == ground).all());
  // 50 m straight below, and 1 km away.
  const Vec3 down = lookAlong(-1.57, 1.0);
  EXPECT_LT((air.seenBehind(from, down, ground) - air.seen(down, 50.0f, ground)).abs().maxCoeff(),
            1e-4f);
  const Vec3 low = lookAlong(-0.05, 1.0);
  EXPECT_LT((air.seenBehind(from, low, ground) - air.seen(low, 1002.0f, ground)).abs().maxCoeff(),
            1e-2f);
  // 25 km away, before the horizon (0.23° below eye level).
  const Vec3 last = lookAlong(-0.00398, 1.0);
  EXPECT_GT((air.seenBehind(from, last, ground) - ground).abs().maxCoeff(), 0.2f);
}

TEST(Air, TheGroundIsAsFarBelowAsTheEyeStandsInTheScene) {
  // Units of 2 m; up in the asset's frame is +x, and heights count from x = 7.
  Air air = test::clearAir(2);
  const Mat3d assetFromSun = Eigen::AngleAxisd(-kPi / 2, Vec3d::UnitZ()).toRotationMatrix();
  air.sunFromAsset = assetFromSun.transpose();
  air.ground = Vec3(7, 100, -20);
  const Rgb ground(2.0f, 1.0f, 0.5f);
  const Vec3 down = (assetFromSun * lookAlong(-1.57, 1.0).cast<double>()).cast<float>();
  const auto seen = [&](float x) { return air.seenBehind(Vec3(x, -3, 5), down, ground); };
  // The viewer of the table is at 50 m, and no eye is lower.
  for (const float x : {-500.0f, 7.0f, 31.0f})
    EXPECT_LT((seen(x) - air.seen(down, 25.0f, ground)).abs().maxCoeff(), 1e-4f) << x;
  EXPECT_LT((seen(1007.0f) - air.seen(down, 1000.0f, ground)).abs().maxCoeff(), 1e-4f);
  EXPECT_GT((seen(1007.0f) - seen(7.0f)).abs().maxCoeff(), 0.02f);
}

TEST(Air, TheFarGroundFadesTowardsTheHorizonFromAnyHeight) {
  Air air = test::clearAir();
  const Rgb ground = Rgb::Zero();
  // From high above, down to the horizon of the table's viewer, which is farther than its own ground.
  for (const float height : {0.0f, 300.0f, 3000.0f}) {
    float before = 0;
    for (double elevation = -0.6; elevation < -0.004; elevation += 0.004) {
      const Rgb seen = air.seenBehind(Vec3(0, height, 0), lookAlong(elevation, 1.5), ground);
      EXPECT_GE(seen[2], 0.995f * before) << height << ' ' << elevation;
      before = seen[2];
    }
    EXPECT_GT(before, 0.5f) << height;
  }
}

TEST(Air, KnowsUnitsAndFrames) {
  const Air metres = test::clearAir(), kilometres = test::clearAir(1000);
  const Vec3 direction = lookAlong(-0.003, 1.0);
  const Rgb expected = metres.seen(direction, 7000.0f, kSent);
  EXPECT_LT((kilometres.seen(direction, 7.0f, kSent) - expected).abs().maxCoeff(), 1e-4f);
  EXPECT_GT((expected - kSent).abs().maxCoeff(), 0.1f);
  Air turned = metres;
  const Mat3d assetFromSun =
      Eigen::AngleAxisd(0.7, Vec3d(0.3, 0.9, -0.2).normalized()).toRotationMatrix();
  turned.sunFromAsset = assetFromSun.transpose();
  const Vec3 there = (assetFromSun * direction.cast<double>()).cast<float>();
  EXPECT_LT((turned.seen(there, 7000.0f, kSent) - expected).abs().maxCoeff(), 2e-3f);
}

TEST(Air, WantsAPerspectiveCameraAndAScale) {
  PictureOptions options;
  scene::Camera camera;
  camera.orthographicHalfHeight = 1.0f;
  EXPECT_TRUE(checkCamera(camera, options));
  options.air = test::clearAir();
  EXPECT_FALSE(checkCamera(camera, options));
  camera.orthographicHalfHeight.reset();
  EXPECT_TRUE(checkCamera(camera, options));
  EXPECT_TRUE(checkOptions(options));
  for (const double scale : {0.0, -1.0, std::nan("")}) {
    options.air->metresPerUnit = scale;
    EXPECT_FALSE(checkOptions(options)) << scale;
  }
}

}  // namespace
}  // namespace lambent::shade
