#include "lambent/sky/preetham.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/test_angles.h"
#include "lambent/sky/twilight.h"

namespace lambent::sky {
namespace {

// Turbidity, Sun's zenith angle in degrees, zenith luminance in cd/m², zenith x and y, and
// luminance at 60° from the zenith, 90° of azimuth from the Sun: reference rows computed apart from
// this code.
constexpr double kPreethamRows[][6] = {
    {2, 0, 15500.7, 0.26674, 0.27720, 8041.5},    {2, 30, 5886.7, 0.25142, 0.25592, 6858.7},
    {2, 60, 3487.3, 0.23801, 0.24199, 6447.3},    {2, 80, 2457.5, 0.25800, 0.27088, 5284.4},
    {2, 85, 2221.5, 0.26900, 0.28580, 4878.6},    {2, 88, 2081.4, 0.27700, 0.29652, 4615.3},
    {3, 0, 29477.3, 0.27068, 0.28236, 10386.4},   {3, 30, 10413.1, 0.25343, 0.25979, 8003.7},
    {3, 60, 5139.2, 0.24493, 0.25257, 6195.7},    {3, 80, 2829.3, 0.26316, 0.27831, 3957.6},
    {3, 85, 2298.2, 0.27234, 0.29046, 3284.6},    {3, 88, 1982.6, 0.27890, 0.29903, 2862.8},
    {6, 0, 57179.8, 0.28250, 0.29784, 17140.4},   {6, 30, 22066.7, 0.26313, 0.27599, 13080.5},
    {6, 60, 9585.3, 0.26547, 0.28179, 8495.6},    {6, 80, 3800.6, 0.28016, 0.30086, 3870.5},
    {6, 85, 2457.0, 0.28557, 0.30752, 2560.6},    {6, 88, 1657.8, 0.28915, 0.31187, 1748.6},
    {10, 0, 76355.6, 0.29826, 0.31848, 27777.1},  {10, 30, 33739.7, 0.28458, 0.30828, 20788.1},
    {10, 60, 14360.3, 0.29237, 0.31481, 12046.4}, {10, 80, 4760.6, 0.30636, 0.33148, 4485.8},
    {10, 85, 2503.4, 0.31068, 0.33744, 2414.9},   {10, 88, 1158.9, 0.31341, 0.34138, 1133.2},
};

TEST(Preetham, ReferenceRows) {
  for (const auto& [turbidity, zenith, luminance, x, y, aside] : kPreethamRows) {
    const ZenithColor color = preethamZenith(turbidity, zenith * test::kDegree);
    EXPECT_NEAR(color.luminance, luminance, 1e-4 * luminance + .05) << turbidity << " " << zenith;
    EXPECT_NEAR(color.x, x, 1e-4) << turbidity << " " << zenith;
    EXPECT_NEAR(color.y, y, 1e-4) << turbidity << " " << zenith;
    const PreethamSky sky = preethamSky(turbidity, kPi / 2 - zenith * test::kDegree);
    const Vec3d up(0, 1, 0), across(0, .5, std::sqrt(3) / 2);
    EXPECT_NEAR(sky.luminance(up), luminance, 1e-4 * luminance + .05);
    EXPECT_NEAR(sky.luminance(across), aside, 1e-4 * aside + .05) << turbidity << " " << zenith;
    EXPECT_NEAR(sky.xyY(up)[0], x, 1e-4);
    EXPECT_NEAR(sky.xyY(up)[1], y, 1e-4);
  }
}

TEST(Preetham, SpectrumHasTheColour) {
  const PreethamSky sky = preethamSky(3, 40 * test::kDegree);
  std::vector<double> nm;
  for (double at = 360; at <= 830; at += 10) nm.push_back(at);
  for (const Vec3d& direction : {Vec3d(0, 1, 0), Vec3d(-.8, .6, 0), Vec3d(0, .1, .995)}) {
    const radiometry::Xyzv expected = sky.color(direction);
    const radiometry::Xyzv seen = radiometry::xyzvOf(nm, sky.spectrum(direction, nm));
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(seen[k] / expected[k], 1, 5e-3) << k;
    }
  }
}

TEST(Preetham, ZenithDoesNotJump) {
  // The Sun climbs through the zenith; nothing moves by more than its own slope allows.
  for (const double turbidity : {2., 4., 8.}) {
    double before = preethamSky(turbidity, 80 * test::kDegree).luminance(Vec3d(0, 1, 0));
    for (double elevation = 80.05; elevation <= 90.001; elevation += .05) {
      const double now =
          preethamSky(turbidity, elevation * test::kDegree).luminance(Vec3d(0, 1, 0));
      EXPECT_LT(std::abs(now / before - 1), .01) << turbidity << " " << elevation;
      before = now;
    }
  }
}

TEST(Preetham, FadesThroughSunset) {
  const Vec3d direction = Vec3d(.5, .5, .3).normalized();
  double before = preethamSky(3, .5 * test::kDegree).luminance(direction);
  for (double elevation = .4; elevation > -18.01; elevation -= .1) {
    const double now = preethamSky(3, elevation * test::kDegree).luminance(direction);
    EXPECT_LE(now, before * 1.001) << elevation;
    EXPECT_GE(now, before * .87) << elevation;  // a decade in less than 2° at the steepest
    before = now;
  }
  EXPECT_GT(before, 0);
}

TEST(PreethamSun, Transmittance) {
  // Without aerosols at 550 nm, away from the bands of gases and water: Rayleigh and ozone alone.
  const double m = kastenAirMass(kPi / 2);
  EXPECT_NEAR(preethamSunTransmittance({1, .35, 2, 1.3}, kPi / 2, 550),
              std::exp(-m * (.008735 * std::pow(.55, -4.08) +
                             (.04608 - .04586) * std::pow(.55, -1.3) + .085 * .35)),
              1e-9);
  for (const double elevation : {-5., 0., 3., 20., 90.}) {
    for (double nm = 330; nm <= 830; nm += 7) {
      double before = 1;
      for (const double turbidity : {1., 2., 4., 10.}) {
        const double t = preethamSunTransmittance({turbidity}, elevation * test::kDegree, nm);
        EXPECT_TRUE(t >= 0 && t <= before) << nm << " " << elevation << " " << turbidity;
        before = t;
      }
    }
  }
  // The setting Sun is red.
  EXPECT_LT(preethamSunTransmittance({2}, 0, 450), .05 * preethamSunTransmittance({2}, 0, 650));
}

TEST(AirMass, KnownValues) {
  EXPECT_NEAR(kastenAirMass(kPi / 2), 1, 1e-3);
  EXPECT_NEAR(kastenAirMass(30 * test::kDegree), 2, .01);
  EXPECT_NEAR(kastenAirMass(0), 36.5, .05);
  EXPECT_NEAR(kastenYoungAirMass(0), 37.92, .05);
  EXPECT_NEAR(kastenYoungAirMass(10 * test::kDegree), 5.586, .01);
  EXPECT_DOUBLE_EQ(kastenAirMass(-.1), kastenAirMass(0));
}

TEST(Twilight, MonotoneAndOfKnownDepth) {
  EXPECT_DOUBLE_EQ(twilightFactor(.3), 1);
  EXPECT_DOUBLE_EQ(twilightFactor(0), 1);
  // Tables of twilight: 3.4 lx at the end of civil twilight, .008 and .0006 of nautical and
  // astronomical.
  EXPECT_NEAR(758.6 * twilightFactor(-6 * test::kDegree), 3.4, .3);
  EXPECT_NEAR(758.6 * twilightFactor(-12 * test::kDegree), .0083, .001);
  EXPECT_NEAR(758.6 * twilightFactor(-18 * test::kDegree), .00065, .0001);
  double before = 1;
  for (double degrees = 0; degrees > -18; degrees -= .05) {
    const double now = twilightFactor(degrees * test::kDegree);
    EXPECT_LE(now, before);
    EXPECT_GT(now, before * .93);
    before = now;
  }
  EXPECT_DOUBLE_EQ(twilightFactor(-1), twilightFactor(-18 * test::kDegree));
}

}  // namespace
}  // namespace lambent::sky
