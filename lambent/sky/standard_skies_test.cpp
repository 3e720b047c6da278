#include "lambent/sky/standard_skies.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

Vec3d at(double zenithDegrees, double azimuthDegrees) {
  const double theta = zenithDegrees * test::kDegree, phi = azimuthDegrees * test::kDegree;
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

// Type, a, b, c, d, e: CIE S 011/E:2003, table 1.
constexpr double kGeneralSkies[][6] = {
    {1, 4, -0.7, 0, -1.0, 0},        {2, 4, -0.7, 2, -1.5, 0.15},
    {3, 1.1, -0.8, 0, -1.0, 0},      {4, 1.1, -0.8, 2, -1.5, 0.15},
    {5, 0, -1, 0, -1.0, 0},          {6, 0, -1, 2, -1.5, 0.15},
    {7, 0, -1, 5, -2.5, 0.3},        {8, 0, -1, 10, -3.0, 0.45},
    {9, -1, -0.55, 2, -1.5, 0.15},   {10, -1, -0.55, 5, -2.5, 0.3},
    {11, -1, -0.55, 10, -3.0, 0.45}, {12, -1, -0.32, 10, -3.0, 0.45},
    {13, -1, -0.32, 16, -3.0, 0.3},  {14, -1, -0.15, 16, -3.0, 0.3},
    {15, -1, -0.15, 24, -2.8, 0.15},
};

TEST(StandardSkies, EveryRowOfTheTable) {
  for (const auto& [type, a, b, c, d, e] : kGeneralSkies) {
    const StandardSkyShape& shape = standardSkyShape(int(type));
    for (const double sunZenith : {0., 30., 60., 85.}) {
      for (const double zenith : {0., 20., 50., 75., 88.}) {
        for (const double azimuth : {0., 45., 90., 180.}) {
          const double cosChi =
              std::cos(sunZenith * test::kDegree) * std::cos(zenith * test::kDegree) +
              std::sin(sunZenith * test::kDegree) * std::sin(zenith * test::kDegree) *
                  std::cos(azimuth * test::kDegree);
          const double chi = std::acos(std::min(cosChi, 1.0));
          const auto f = [&, c = c, d = d, e = e](double angle) {
            return 1 + c * (std::exp(d * angle) - std::exp(d * kPi / 2)) +
                   e * std::cos(angle) * std::cos(angle);
          };
          const double expected = f(chi) *
                                  (1 + a * std::exp(b / std::cos(zenith * test::kDegree))) /
                                  (f(sunZenith * test::kDegree) * (1 + a * std::exp(b)));
          EXPECT_NEAR(
              relativeLuminance(shape, (90 - sunZenith) * test::kDegree, at(zenith, azimuth)),
              expected, 1e-4 * expected)
              << type << " " << sunZenith << " " << zenith << " " << azimuth;
        }
      }
    }
  }
}

TEST(StandardSkies, LevelIsThatOfThePublishedZenithLuminance) {
  // darula2002cie: type, D_v / E_v, and L_z = D_v / E_v (B sin^C h / cos^D h + E sin h) kcd/m².
  constexpr double kDarulaKittler[][6] = {
      {1, .10, 54.63, 1.00, 0, 0},        {2, .18, 12.35, 3.68, .59, 50.47},
      {3, .15, 48.30, 1.00, 0, 0},        {4, .22, 12.23, 3.57, .57, 44.27},
      {5, .20, 42.59, 1.00, 0, 0},        {6, .38, 11.84, 3.53, .55, 38.78},
      {7, .42, 21.72, 4.52, .64, 34.56},  {8, .41, 29.35, 4.94, .70, 30.41},
      {9, .40, 10.34, 3.45, .50, 27.47},  {10, .36, 18.41, 4.27, .63, 24.04},
      {11, .23, 24.41, 4.60, .72, 20.76}, {12, .10, 23.00, 4.43, .74, 18.52},
      {13, .28, 27.45, 4.61, .76, 16.59}, {14, .28, 25.54, 4.40, .79, 14.56},
      {15, .30, 28.08, 4.13, .79, 13.00},
  };
  for (const auto& [type, ratio, b, c, d, e] : kDarulaKittler) {
    EXPECT_DOUBLE_EQ(standardSkyShape(int(type)).diffuseRatio, ratio);
    for (const double elevation : {20., 35., 50., 60.}) {
      const double h = elevation * test::kDegree;
      const double published =
          1000 * ratio *
          (b * std::pow(std::sin(h), c) / std::pow(std::cos(h), d) + e * std::sin(h));
      EXPECT_NEAR(standardSky(int(type), h).zenithLuminance / published, 1, .05)
          << type << " " << elevation;
    }
  }
}

TEST(StandardSkies, UniformAndOvercastInClosedForm) {
  EXPECT_NEAR(onHorizontalPlane([](const Vec3d&) { return 1.0; }), kPi, 1e-12);
  const OvercastSky overcast = cieOvercast(30 * test::kDegree);
  EXPECT_NEAR(overcast.zenithLuminance, 123 + 4300, 1e-9);
  EXPECT_NEAR(onHorizontalPlane([&](const Vec3d& s) { return overcast.luminance(s); }),
              overcast.zenithLuminance * 7 * kPi / 9, 1e-9);
  EXPECT_NEAR(overcast.luminance(at(90, 10)), overcast.zenithLuminance / 3, 1e-9);
  const GradedSky uniform = standardSky(5, 30 * test::kDegree);
  EXPECT_NEAR(uniform.luminance(at(70, 20)), uniform.zenithLuminance, 1e-9);
}

TEST(StandardSkies, QuadratureOfTheDome) {
  for (const int type : {1, 8, 12, 15}) {
    for (const double elevation : {5., 40., 88.}) {
      const GradedSky sky = standardSky(type, elevation * test::kDegree);
      const auto luminance = [&](const Vec3d& s) { return sky.luminance(s); };
      const double fine = onHorizontalPlane(luminance, domeQuadrature(200, 200));
      EXPECT_NEAR(onHorizontalPlane(luminance) / fine, 1, 1e-3) << type << " " << elevation;
      EXPECT_NEAR(onHorizontalPlane(luminance, domeQuadrature(64, 64)) / fine, 1, 2e-4)
          << type << " " << elevation;
    }
  }
}

TEST(ClearSky, AnchorsOfGensky) {
  // gensky +s with the Sun at 45° and its turbidity of 2.45: a zenith of 9.563 W/m²/sr by an
  // efficacy of 203 lm/W, and the normalisation .5707 = .274 f(45°).
  const GradedSky sky = cieClear(45 * test::kDegree);
  EXPECT_NEAR(sky.zenithLuminance / 203, 9.563, 1e-3);
  SkyAngles toSun;
  toSun.sun = 45 * test::kDegree;
  toSun.cosSun = std::cos(toSun.sun);
  EXPECT_NEAR(.274 * sky.indicatrix.at(toSun), .5707, 1e-4);
  EXPECT_NEAR(1 - std::exp(-.32), .274, 2e-4);
}

TEST(ClearSky, FormulaOf1973) {
  const double sunZenith = 50 * test::kDegree;
  const GradedSky sky = cieClear(kPi / 2 - sunZenith);
  for (const double zenith : {0., 30., 60., 85.}) {
    for (const double azimuth : {0., 90., 180.}) {
      const double gamma =
          std::acos(std::min(std::cos(sunZenith) * std::cos(zenith * test::kDegree) +
                                 std::sin(sunZenith) * std::sin(zenith * test::kDegree) *
                                     std::cos(azimuth * test::kDegree),
                             1.0));
      const auto f = [](double g) {
        return .91 + 10 * std::exp(-3 * g) + .45 * std::cos(g) * std::cos(g);
      };
      const double expected = sky.zenithLuminance * f(gamma) *
                              (1 - std::exp(-.32 / std::cos(zenith * test::kDegree))) /
                              (f(sunZenith) * (1 - std::exp(-.32)));
      EXPECT_NEAR(sky.luminance(at(zenith, azimuth)), expected, 1e-4 * expected);
    }
  }
}

TEST(ClearSky, SunInTheZenithIsFinite) {
  EXPECT_LT(cieClear(90 * test::kDegree).zenithLuminance, 15e3);
  EXPECT_GT(cieClear(90 * test::kDegree).zenithLuminance,
            cieClear(75 * test::kDegree).zenithLuminance);
}

}  // namespace
}  // namespace lambent::sky
