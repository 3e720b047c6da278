// A sky above a horizon and the ground below it. environment_test.cpp holds both to what every light
// must do.
#include "lambent/light/skylight.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "lambent/light/environment.h"
#include "lambent/light/test_skylight.h"
#include "lambent/math/directions.h"
#include "lambent/math/random.h"

namespace lambent::light {
namespace {

const Rgb kSky(1, 2, 3), kGround(0.3f, 0.2f, 0.1f);

Environment world(double horizon) {
  return Environment::skylight(std::make_shared<test::Glow>(horizon, kSky), Mat3::Identity()) +
         Environment::ground(Vec3::UnitY(), horizon, kGround);
}

Vec3 at(double azimuth, double elevation) {
  return math::directionFromAzimuthElevation(azimuth, elevation).cast<float>();
}

TEST(Skylight, EndsWhereTheGroundBegins) {
  for (const double horizon : {-0.3, 0.0, 0.2}) {
    const Environment light = world(horizon);
    for (const double azimuth : {-3.0, -1.0, 0.0, 2.5}) {
      EXPECT_GT(light.radiance(at(azimuth, horizon + 1e-6))[2], 0.3f);
      EXPECT_TRUE((light.radiance(at(azimuth, horizon - 1e-6)) == kGround).all());
    }
  }
  // A level ray sees one of the two, and never both or neither.
  math::Random random(1, 1);
  for (int k = 0; k < 1000; ++k) {
    const float turn = 6.2831853f * random.uniform();
    const Rgb seen = world(0).radiance(Vec3(std::cos(turn), 0, std::sin(turn)));
    EXPECT_TRUE((seen == kGround).all());
  }
}

TEST(Skylight, GroundIsACapInHarmonics) {
  for (const double horizon : {-0.3, 0.0, 0.2}) {
    const auto f = Environment::ground(Vec3::UnitY(), horizon, kGround).project(10);
    const auto expected = Environment::disc(-Vec3::UnitY(), kPi + 2 * horizon, kGround).project(10);
    for (std::size_t i = 0; i < f.values.size(); ++i)
      EXPECT_NEAR(f.values[i], expected.values[i], 1e-6);
  }
}

TEST(Skylight, IsToldInParts) {
  const auto glow = std::make_shared<test::Glow>(0.1, kSky);
  const Mat3 turn = math::randomRotation(5);
  const Environment light = Environment::skylight(glow, Mat3::Identity()).rotated(turn) +
                            Environment::skylight(glow, Mat3::Identity()) +
                            Environment::ground(turn.col(1), 0.1, kGround);
  const Environment::Parts parts = light.parts();
  ASSERT_TRUE(parts.sky);
  EXPECT_EQ(parts.sky->light, glow);
  EXPECT_TRUE(parts.sky->worldFromSky.isApprox(turn));
  EXPECT_NEAR(parts.sky->horizon, std::sin(0.1), 1e-12);
  EXPECT_EQ(parts.others.size(), 1u);  // the second sky
  ASSERT_EQ(parts.discs.size(), 1u);
  const Environment ground = Environment::disc(parts.discs[0]);
  math::Random random(2, 2);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 s = math::uniformSphere(random.uniform2());
    const bool below = s.dot(turn.col(1)) < std::sin(0.1f);
    EXPECT_TRUE((ground.radiance(s) == (below ? kGround : Rgb(Rgb::Zero()))).all());
  }
}

}  // namespace
}  // namespace lambent::light
