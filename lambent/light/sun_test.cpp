#include "lambent/light/sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

namespace lambent::light {
namespace {

Environment::LimbDarkened real() {
  return {.direction = Vec3(0.3f, 0.8f, -0.5f).normalized(),
          .angularDiameter = 0.0093,
          .irradiance = Rgb(3, 2, 1),
          .darkening = Rgb(0.4f, 0.55f, 0.7f)};
}

TEST(Sun, IsTheBrightestSmallDisc) {
  EXPECT_FALSE(sunOf(Environment::uniform(Rgb::Ones())));
  EXPECT_FALSE(sunOf(Environment::disc(Vec3::UnitY(), 5.1 * kPi / 180, Rgb::Ones())));
  EXPECT_FALSE(sunOf(Environment::disc(Vec3::UnitY(), 0.01, Rgb::Zero())));
  const Environment light = Environment::uniform(Rgb::Ones()) + Environment::disc(real()) +
                            Environment::disc(Vec3::UnitX(), 0.01, Rgb::Constant(9)) +
                            Environment::disc(Vec3::UnitY(), 1, Rgb::Constant(100));
  const auto sun = sunOf(light);
  ASSERT_TRUE(sun);
  EXPECT_LT((sun->disc.axis - real().direction).norm(), 1e-6f);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sun->irradiance[c], real().irradiance[c], 1e-4f * real().irradiance[c]);
  const sh::RgbCoefficients own = project(*sun, 5), all = Environment::disc(real()).project(5);
  for (std::size_t i = 0; i < all.values.size(); ++i) EXPECT_EQ(own.values[i], all.values[i]);
}

TEST(Sun, BelowTheHorizonIsNone) {
  Environment::LimbDarkened low = real();
  low.horizon = std::asin(low.direction.y()) + 0.0047;
  EXPECT_FALSE(sunOf(Environment::disc(low)));
}

TEST(Sun, PointsStandForTheWhole) {
  for (const double cut : {-1.0, -0.003, 0.0, 0.004}) {
    Environment::LimbDarkened disc = real();
    if (cut > -1) disc.horizon = std::asin(disc.direction.y()) + cut;
    const auto sun = sunOf(Environment::disc(disc));
    ASSERT_TRUE(sun) << cut;
    for (const int count : {1, 2, 3, 16, 61, 256}) {
      const std::vector<SunPoint> points = pointsOf(*sun, count);
      ASSERT_EQ(points.size(), std::size_t(count));
      Rgb mean = Rgb::Zero();
      Vec3 middle = Vec3::Zero();
      for (const SunPoint& point : points) {
        mean += point.irradiance / float(count);
        middle += point.direction / float(count);
        EXPECT_NEAR(point.direction.norm(), 1, 1e-6f);
        EXPECT_LT(std::acos(std::min(1.0, double(point.direction.dot(disc.direction)))), 0.0049);
        EXPECT_GE(std::asin(point.direction.y()), disc.horizon - 2e-6);
      }
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c], sun->irradiance[c], 1e-5f * sun->irradiance[c]) << count;
      EXPECT_LT((middle - disc.direction).norm(), count == 256 && cut == -1 ? 2e-4f : 0.0049f);
    }
  }
}

// Of a flat disc, the share of the points within half of its radius is a quarter.
TEST(Sun, PointsAreEven) {
  const Environment flat = Environment::disc(Vec3::UnitY(), 0.08, Rgb::Ones());
  const std::vector<SunPoint> points = pointsOf(*sunOf(flat), 400);
  int inner = 0, right = 0;
  for (const SunPoint& point : points) {
    inner += std::hypot(point.direction.x(), point.direction.z()) < 0.02f;
    right += point.direction.x() > 0;
  }
  EXPECT_NEAR(inner, 100, 2);
  EXPECT_NEAR(right, 200, 6);
}

TEST(Sun, TurnsWithItsLight) {
  const Mat3 turn = Eigen::AngleAxisf(0.7f, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Environment::LimbDarkened disc = real();
  disc.horizon = std::asin(disc.direction.y());
  const Sun before = turned(turn, *sunOf(Environment::disc(disc)));
  const auto after = sunOf(Environment::disc(disc).rotated(turn));
  ASSERT_TRUE(after);
  EXPECT_LT((before.disc.axis - after->disc.axis).norm(), 1e-6f);
  EXPECT_LT((before.disc.up - after->disc.up).norm(), 1e-6f);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(before.irradiance[c], after->irradiance[c], 1e-3f * after->irradiance[c]);
}

}  // namespace
}  // namespace lambent::light
