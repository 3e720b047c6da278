#include "lambent/sky/haze.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

using test::kDegree;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Air whose f and L_in are told by hand: 1/e at 1 km, and all scattered light 0.5.
ConstantAir evenAir() {
  ConstantAir air;
  air.extinction = Eigen::Array3d::Constant(1e-3);
  air.aerosol = Eigen::Array3d::Constant(0.5e-3 * 4 * kPi);
  air.aerosolPhase = media::Isotropic{};
  return air;
}

HazeOptions throughCamera(int width, int height) {
  HazeOptions options;
  options.shape = {PictureMap::Camera, width, height, 0.3, 0.1, 1.0};
  return options;
}

image::Image filled(int width, int height, const Rgb& value) {
  image::Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = value;
  return image;
}

class WhiteDome : public Dome {
 public:
  radiometry::Xyzv color(const Vec3d&) const override {
    return radiometry::Xyzv(0.95047, 1, 1.08883, 1) * (2 * radiometry::kPhotopicEfficacy);
  }
  void spectrum(const Vec3d&, std::span<const double>, std::span<double>) const override {}
};

TEST(Haze, IsExtinctionAndInScatteredLight) {
  const image::Image color = filled(16, 12, Rgb(2, 1, 0)), depth = filled(16, 12, Rgb(700, 0, 0));
  const auto hazy = haze(color, depth, evenAir(), throughCamera(16, 12));
  ASSERT_TRUE(hazy);
  const float f = std::exp(-0.7f);
  for (const Rgb& pixel : hazy->pixels)
    EXPECT_LT((pixel - (f * Rgb(2, 1, 0) + 0.5f * (1 - f))).abs().maxCoeff(), 1e-6f);
}

TEST(Haze, DepthAlongTheAxisIsShorterThanTheRay) {
  HazeOptions options = throughCamera(16, 12);
  options.depth = DepthAlong::Axis;
  options.metres = 1000;
  const image::Image black = filled(16, 12, Rgb::Zero()), depth = filled(16, 12, Rgb(0.5f, 9, 9));
  const auto hazy = haze(black, depth, evenAir(), options);
  ASSERT_TRUE(hazy);
  const double half = std::tan(0.5);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const double across = half * 16 / 12 * (2 * (x + 0.5) / 16 - 1);
      const double upwards = half * (1 - 2 * (y + 0.5) / 12);
      const double distance = 500 * std::sqrt(1 + across * across + upwards * upwards);
      EXPECT_NEAR(double(hazy->at(x, y)[1]), 0.5 * (1 - std::exp(-1e-3 * distance)), 1e-6);
    }
}

TEST(Haze, LeavesWhereNothingStands) {
  image::Image color = filled(8, 8, Rgb(1, 2, 3)), depth = filled(8, 8, Rgb(100, 0, 0));
  const float nothing[] = {kInfinite, -kInfinite, std::nanf(""), 0, -5, 1e10f};
  for (int i = 0; i < 6; ++i) depth.at(i, 3)[0] = nothing[i];
  const auto hazy = haze(color, depth, evenAir(), throughCamera(8, 8));
  ASSERT_TRUE(hazy);
  for (int i = 0; i < 6; ++i) EXPECT_TRUE((hazy->at(i, 3) == Rgb(1, 2, 3)).all()) << i;
  EXPECT_LT(hazy->at(6, 3)[2], 3);
}

TEST(Haze, CoversAsMuchAsTheSurfaceDoes) {
  image::Image color = filled(8, 8, Rgb(0.25f, 0.25f, 0.25f));
  image::Image depth = filled(8, 8, Rgb(1000, 0, 0));
  color.alpha.assign(64, 0.25f);  // a surface of radiance 1
  depth.at(0, 0)[0] = kInfinite;
  color.at(0, 0) = Rgb::Zero();
  HazeOptions options = throughCamera(8, 8);
  const auto hazy = haze(color, depth, evenAir(), options);
  ASSERT_TRUE(hazy);
  const float f = std::exp(-1.0f), surface = f + 0.5f * (1 - f);
  EXPECT_EQ(hazy->alpha, color.alpha);
  EXPECT_NEAR(hazy->at(4, 4)[0], 0.25f * surface, 1e-6f);
  EXPECT_EQ(hazy->at(0, 0)[0], 0);
  // Before a sky of radiance 2.
  Sky sky;
  sky.dome = std::make_shared<WhiteDome>();
  options.backdrop = &sky;
  const auto whole = haze(color, depth, evenAir(), options);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->alpha.empty());
  EXPECT_NEAR(whole->at(4, 4)[1], 0.25f * surface + 0.75f * 2, 1e-3f);
  EXPECT_NEAR(whole->at(0, 0)[1], 2, 1e-3f);
}

TEST(Haze, TurnsWithTheSun) {
  // Forward scattering: brightest where one looks towards the Sun, which stands in the east.
  ConstantAir air = evenAir();
  air.aerosolPhase = media::HenyeyGreenstein{0.7};
  air.sun = Vec3d(std::cos(0.2), std::sin(0.2), 0);
  HazeOptions options;
  options.shape = {PictureMap::LatLong, 64, 32};
  options.worldFromSun.col(0) = Vec3d::UnitX();
  const image::Image black = filled(64, 32, Rgb::Zero()), depth = filled(64, 32, Rgb(500, 0, 0));
  for (const bool east : {true, false}) {
    if (!east) options.worldFromSun = Eigen::DiagonalMatrix<double, 3>(-1, 1, -1);  // in the west
    const auto hazy = haze(black, depth, air, options);
    ASSERT_TRUE(hazy);
    int best = 0;
    for (int i = 0; i < 64 * 32; ++i)
      if (hazy->pixels[std::size_t(i)][0] > hazy->pixels[std::size_t(best)][0]) best = i;
    const Vec3d direction = *directionOfPixel(options.shape, best % 64, best / 64);
    EXPECT_GT(direction.x() * (east ? 1 : -1), 0.95);
  }
}

TEST(Haze, RefusesWhatDoesNotFit) {
  const image::Image color = filled(16, 12, Rgb::Zero());
  HazeOptions options = throughCamera(16, 12);
  EXPECT_FALSE(haze(color, filled(12, 16, Rgb::Zero()), evenAir(), options));
  EXPECT_FALSE(haze(color, color, evenAir(), throughCamera(32, 24)));
  options.metres = 0;
  EXPECT_FALSE(haze(color, color, evenAir(), options));
  options = throughCamera(16, 8);
  options.shape.map = PictureMap::LatLong;
  options.depth = DepthAlong::Axis;
  const image::Image map = filled(16, 8, Rgb::Zero());
  EXPECT_FALSE(haze(map, map, evenAir(), options));
  EXPECT_EQ(haze(map, map, evenAir(), options).error().kind, ErrorKind::BadUsage);
}

}  // namespace
}  // namespace lambent::sky
