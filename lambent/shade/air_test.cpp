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

TEST(Air, LiesBeforeTheGroundOfABackground) {
  const Air air = test::clearAir();
  const Rgb ground(2.0f, 1.0f, 0.5f);
  for (const double elevation : {0.0, 0.3, 1.5})
    EXPECT_TRUE((air.seenBehind(lookAlong(elevation, 1.0), ground) == ground).all());
  // 50 m straight below, and 1 km away.
  const Vec3 down = lookAlong(-1.57, 1.0);
  EXPECT_LT((air.seenBehind(down, ground) - air.seen(down, 50.0f, ground)).abs().maxCoeff(), 1e-4f);
  const Vec3 low = lookAlong(-0.05, 1.0);
  EXPECT_LT((air.seenBehind(low, ground) - air.seen(low, 1002.0f, ground)).abs().maxCoeff(), 1e-2f);
  // 25 km away, before the horizon (0.23° below eye level).
  const Vec3 last = lookAlong(-0.00398, 1.0);
  EXPECT_GT((air.seenBehind(last, ground) - ground).abs().maxCoeff(), 0.2f);
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
