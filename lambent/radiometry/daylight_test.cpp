#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lambent/radiometry/spectra.h"

namespace lambent::radiometry {
namespace {

std::vector<double> wavelengthsOfDaylight() {
  std::vector<double> nm;
  for (double at = 300; at <= 830; at += 5) {
    nm.push_back(at);
  }
  return nm;
}

TEST(Daylight, RegeneratesD65) {
  // CIE's locus at 6504 K, and CIE's table of illuminant D65.
  const double t = 6504;
  const double x = -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + .09911e3 / t + .244063;
  const double y = -3 * x * x + 2.870 * x - .275;
  const DaylightCoefficients d65 = daylightCoefficients(x, y);
  EXPECT_NEAR(d65.m1, -.295, .001);
  EXPECT_NEAR(d65.m2, -.688, .002);
  const double table[][2] = {{300, .0341},   {350, 44.9117}, {380, 49.9755}, {400, 82.7549},
                             {450, 117.008}, {500, 109.354}, {550, 104.046}, {560, 100},
                             {600, 90.0062}, {650, 80.0268}, {700, 71.6091}, {750, 63.5927},
                             {780, 63.3828}, {830, 60.3125}};
  for (const auto& [nm, power] : table) {
    EXPECT_NEAR(daylightPower(d65, nm), power, .05) << nm;
  }
  EXPECT_DOUBLE_EQ(daylightPower(d65, 299), 0);
  EXPECT_DOUBLE_EQ(daylightPower(d65, 831), 0);
}

TEST(Daylight, SpectrumHasItsColourAndLuminance) {
  const std::vector<double> nm = wavelengthsOfDaylight();
  for (const auto& [x, y] : {std::pair{.3127, .3290}, {.25, .26}, {.2350, .2385}, {.38, .377}}) {
    const Xyzv xyzv = xyzvOf(nm, daylightSpectrum(x, y, 5000, nm));
    EXPECT_NEAR(xyzv[1], 5000, 1e-9);
    EXPECT_NEAR(xyzv[0] / xyzv.head<3>().sum(), x, 4e-4) << x;
    EXPECT_NEAR(xyzv[1] / xyzv.head<3>().sum(), y, 4e-4) << x;
    const Xyzv direct = daylightXyzv(x, y, 5000);
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(xyzv[k] / direct[k], 1, 4e-3) << x << " " << k;
    }
  }
}

TEST(Daylight, NeverNegativeNorInfinite) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::vector<double> nm = wavelengthsOfDaylight();
  for (int i = 0; i < 2000; ++i) {
    const double x = uniform(random), y = (1 - x) * uniform(random);
    const std::vector<double> spectrum = daylightSpectrum(x, y, 100, nm);
    for (const double power : spectrum) {
      ASSERT_TRUE(std::isfinite(power) && power >= 0) << x << " " << y;
    }
    ASSERT_NEAR(xyzvOf(nm, spectrum)[1], 100, 1e-6) << x << " " << y;
    ASSERT_TRUE((daylightXyzv(x, y, 100) >= -1e-9).all()) << x << " " << y;
  }
}

}  // namespace
}  // namespace lambent::radiometry
