#include "lambent/sky/reading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/sky/make_sky.h"
#include "lambent/sky/sun_coverage.h"

namespace lambent::sky {
namespace {

class Slope : public Dome {
 public:
  radiometry::Xyzv color(const Vec3d& d) const override {
    return {100, 1000 * (2 + d.y()), 100, 100};
  }
  void spectrum(const Vec3d& d, std::span<const double> nm,
                std::span<double> radiance) const override {
    for (size_t i = 0; i < nm.size(); ++i) radiance[i] = nm[i] * (2 + d.x());
  }
};

Sky slope() {
  Sky sky;
  sky.dome = std::make_shared<Slope>();
  sky.sun.elevation = 0.5;
  sky.sun.angularRadius = 0.00465;
  sky.sun.irradiance = {90000, 100000, 80000, 200000};
  sky.wavelengths = {340, 500, 740};
  sky.sun.spectralIrradiance = {1, 2, 1.5};
  sky.groundRadiance = {0.1, 0.2, 0.1};
  sky.ground = {10, 20, 30, 40};
  return sky;
}

TEST(Reading, IsWhatTheDomeHasInADirection) {
  const Sky sky = slope();
  const std::vector<Vec3d> directions{{1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const auto readings =
      readSky(sky, directions, {.wavelengths = {450, 620}, .below = BelowHorizon::Ground});
  ASSERT_EQ(readings.size(), 3u);
  EXPECT_DOUBLE_EQ(readings[0].radiance[0], 450 * 3.0);
  EXPECT_DOUBLE_EQ(readings[1].radiance[1], 620 * 2.0);
  EXPECT_DOUBLE_EQ(readings[1].luminance, 3000);
  EXPECT_DOUBLE_EQ(readings[2].luminance, 20);
  EXPECT_DOUBLE_EQ(readings[2].radiance[1], 0.15);
  EXPECT_TRUE(readSky(sky, directions, {})[0].radiance.empty());
}

TEST(Reading, TheSunIsSeenWhereItIsAskedFor) {
  const Sky sky = slope();
  const std::vector<Vec3d> directions{{std::cos(0.5), std::sin(0.5), 0},
                                      {std::cos(0.51), std::sin(0.51), 0}};
  const auto without = readSky(sky, directions, {.wavelengths = {500}});
  const auto with = readSky(sky, directions, {.wavelengths = {500}, .sun = true});
  EXPECT_EQ(with[1].luminance, without[1].luminance);
  // In the centre: the mean over the disc times 1 + α/2.
  const double mean = 2 / (kPi * 0.00465 * 0.00465);
  const double disc = with[0].radiance[0] - without[0].radiance[0];
  EXPECT_NEAR(disc / mean, 1 + limbDarkening(500) / 2, 1e-4);
  const double darkening = (1 + limbDarkening(560) / 2) / (1 + limbDarkening(500) / 2);
  EXPECT_NEAR((with[0].luminance - without[0].luminance) / disc / 50000, darkening, 1e-6);
}

TEST(Reading, BrightnessIsTheSumOverWavelengths) {
  const Sky sky = slope();
  const Brightness bright = brightnessOf(sky);
  EXPECT_DOUBLE_EQ(bright.irradiance.directNormal, 160 * 1.5 + 240 * 1.75);
  EXPECT_DOUBLE_EQ(bright.illuminance.directNormal, 100000);
  EXPECT_DOUBLE_EQ(bright.zenithLuminance, 3000);
  EXPECT_NEAR(bright.irradiance.direct, bright.irradiance.directNormal * std::sin(0.5), 1e-9);
  EXPECT_NEAR(bright.illuminance.direct, 100000 * std::sin(0.5), 1e-6);
  EXPECT_DOUBLE_EQ(bright.illuminance.global(),
                   bright.illuminance.direct + bright.illuminance.diffuse);
}

}  // namespace
}  // namespace lambent::sky
