#include "lambent/sky/analytic_sky.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

constexpr Model kAnalyticModels[] = {Model::Preetham,    Model::Perez,    Model::AsrcCie,
                                     Model::CieOvercast, Model::CieClear, Model::CieGeneral};

SkyOptions optionsOf(Model model, double elevationDegrees) {
  SkyOptions options;
  options.model = model;
  options.sunElevation = elevationDegrees * test::kDegree;
  return options;
}

double diffuseIlluminance(const Sky& sky) {
  return onHorizontalPlane([&](const Vec3d& s) { return sky.dome->color(s)[1]; });
}

TEST(ClearSkyIrradiance, OfAClearDay) {
  // T = 3, Sun at 45°: m = 1.413 and 1 / δ_R = 8.882, by hand.
  const MeasuredIrradiance clear = clearSkyIrradiance(3, 45 * test::kDegree);
  EXPECT_NEAR(clear.directNormal, 1367 * std::exp(-.8662 * 3 * 1.413 / 8.882), 1);
  EXPECT_NEAR(clear.diffuseHorizontal, 110, 20);
  // Haze moves light from the Sun to the sky.
  const MeasuredIrradiance hazy = clearSkyIrradiance(6, 45 * test::kDegree);
  EXPECT_LT(hazy.directNormal, clear.directNormal);
  EXPECT_GT(hazy.diffuseHorizontal, clear.diffuseHorizontal);
  const MeasuredIrradiance setting = clearSkyIrradiance(3, 0);
  const MeasuredIrradiance set = clearSkyIrradiance(3, -18 * test::kDegree);
  EXPECT_NEAR(set.diffuseHorizontal / setting.diffuseHorizontal, 8.5e-7, 1e-7);
}

TEST(AnalyticSky, TurbidityFromTheAerosols) {
  Atmosphere atmosphere;
  atmosphere.aerosols = Atmosphere::Angstrom{.04608 * 3 - .04586, 1.3};
  EXPECT_NEAR(turbidityOf(atmosphere), 3, 1e-12);
  atmosphere.aerosols = Atmosphere::Angstrom{0, 1.3};
  EXPECT_DOUBLE_EQ(turbidityOf(atmosphere), 1);
  atmosphere.turbidity = 4;
  EXPECT_DOUBLE_EQ(turbidityOf(atmosphere), 4);
}

TEST(AnalyticSky, DaylightOfAnAfternoon) {
  for (const Model model : kAnalyticModels) {
    const Sky sky = analyticSky(optionsOf(model, 40));
    ASSERT_EQ(sky.wavelengths.size(), 41u);
    const double diffuse = diffuseIlluminance(sky);
    EXPECT_GT(diffuse, 4e3) << int(model);
    EXPECT_LT(diffuse, 4e4) << int(model);
    EXPECT_EQ(sky.sun.irradiance[1] > 0, model != Model::CieOvercast);
    if (model != Model::CieOvercast) {
      // Outside of the air it is 133 klx; the air of the atmosphere by default is clean.
      EXPECT_GT(sky.sun.irradiance[1], 75e3) << int(model);
      EXPECT_LT(sky.sun.irradiance[1], 110e3) << int(model);
      EXPECT_NEAR(radiometry::xyzvOf(sky.wavelengths, sky.sun.spectralIrradiance)[1] /
                      sky.sun.irradiance[1],
                  1, 2e-3);
    }
    // The ground sends back a tenth of what falls on it.
    const double global = diffuse + sky.sun.irradiance[1] * std::sin(40 * test::kDegree);
    EXPECT_NEAR(sky.ground[1] / (.1 * global / kPi), 1, 5e-3) << int(model);
    EXPECT_NEAR(radiometry::xyzvOf(sky.wavelengths, sky.groundRadiance)[1] / sky.ground[1], 1,
                3e-3);
  }
}

TEST(AnalyticSky, MeasuredLevelIsKept) {
  SkyOptions options = optionsOf(Model::Perez, 35);
  options.directNormalIrradiance = 400;
  options.diffuseHorizontalIrradiance = 200;
  const Sky perez = analyticSky(options);
  options.model = Model::AsrcCie;
  const Sky mixture = analyticSky(options);
  EXPECT_NEAR(diffuseIlluminance(perez) / diffuseIlluminance(mixture), 1, 1e-9);
  EXPECT_NEAR(perez.sun.irradiance[1] / 400, 100, 10);  // lm/W
}

TEST(AnalyticSky, SunGoesDownWithoutAStep) {
  for (const Model model : kAnalyticModels) {
    Sky before = analyticSky(optionsOf(model, 1));
    const double scale = before.sun.irradiance[1] + 1;
    for (double elevation = .98; elevation > -1; elevation -= .02) {
      const Sky now = analyticSky(optionsOf(model, elevation));
      EXPECT_LE(now.sun.irradiance[1], before.sun.irradiance[1] + 1e-9) << elevation;
      EXPECT_LT(before.sun.irradiance[1] - now.sun.irradiance[1], .08 * scale) << elevation;
      EXPECT_TRUE(now.ground.isFinite().all() && (now.ground >= 0).all());
      EXPECT_NEAR(now.ground[1] / before.ground[1], 1, .1) << elevation << " " << int(model);
      before = now;
    }
    EXPECT_EQ(before.sun.irradiance[1], 0);
    EXPECT_EQ(before.sun.visible, 0);
  }
}

TEST(AnalyticSky, FiniteWhateverIsAsked) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 60; ++trial) {
    SkyOptions options = optionsOf(kAnalyticModels[trial % 6], -18 + 108 * uniform(random));
    options.cieType = 1 + trial % 15;
    options.atmosphere.turbidity = 1 + 11 * uniform(random);
    options.atmosphere.ozone = 600 * uniform(random);
    options.altitude = 9000 * uniform(random);
    if (trial % 3 == 0) options.directNormalIrradiance = 1200 * uniform(random);
    if (trial % 4 == 0) options.diffuseHorizontalIrradiance = 500 * uniform(random);
    const Sky sky = analyticSky(options);
    std::vector<double> radiance(sky.wavelengths.size());
    for (int i = 0; i < 20; ++i) {
      const double y = 2 * uniform(random) - 1, angle = 2 * kPi * uniform(random);
      const double across = std::sqrt(1 - y * y);
      const Vec3d direction(across * std::cos(angle), y, across * std::sin(angle));
      const radiometry::Xyzv color = sky.dome->color(direction);
      ASSERT_TRUE(color.isFinite().all() && (color >= 0).all()) << trial;
      sky.dome->spectrum(direction, sky.wavelengths, radiance);
      for (const double value : radiance) ASSERT_TRUE(std::isfinite(value) && value >= 0) << trial;
    }
    ASSERT_TRUE(sky.sun.irradiance.isFinite().all() && (sky.sun.irradiance >= 0).all());
    ASSERT_TRUE(sky.ground.isFinite().all() && (sky.ground >= 0).all());
    for (const double value : sky.groundRadiance) ASSERT_TRUE(std::isfinite(value) && value >= 0);
    for (const double value : sky.sun.spectralIrradiance) ASSERT_TRUE(value >= 0);
  }
}

TEST(AnalyticSky, HorizonFromAbove) {
  SkyOptions options = optionsOf(Model::CieOvercast, 30);
  EXPECT_DOUBLE_EQ(analyticSky(options).horizon, 0);
  options.altitude = 10e3;
  EXPECT_NEAR(analyticSky(options).horizon / test::kDegree, -3.2, .1);
}

}  // namespace
}  // namespace lambent::sky
