// What holds of every analytic sky: finite and never negative, for any Sun, any haze, any direction;
// symmetric about the Sun's meridian; without steps in time.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "lambent/sky/analytic_dome.h"
#include "lambent/sky/asrc_cie.h"
#include "lambent/sky/perez.h"
#include "lambent/sky/preetham.h"
#include "lambent/sky/standard_skies.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

/// Every model of luminance for a Sun, a turbidity and measured irradiances.
std::vector<std::function<double(const Vec3d&)>> everySky(double elevation, double turbidity,
                                                          const MeasuredIrradiance& measured) {
  std::vector<std::function<double(const Vec3d&)>> skies;
  const auto add = [&](auto sky) {
    skies.push_back([sky](const Vec3d& d) { return sky.luminance(d); });
  };
  add(cieOvercast(elevation));
  add(cieClear(elevation, turbidity));
  for (int type = 1; type <= 15; ++type) add(standardSky(type, elevation));
  add(perezSky(measured, elevation));
  add(asrcSky(measured, elevation));
  add(preethamSky(turbidity, elevation));
  return skies;
}

TEST(EverySky, FiniteAndNeverNegative) {
  std::mt19937 random(20260621);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 120; ++trial) {
    double elevation = (-18 + 108 * uniform(random)) * test::kDegree;
    if (trial == 0) elevation = kPi / 2;
    if (trial == 1) elevation = 0;
    const double turbidity = 1 + 12 * uniform(random);
    const MeasuredIrradiance measured{1100 * uniform(random) * double(trial % 3 != 0),
                                      600 * uniform(random) * double(trial % 7 != 0)};
    const auto skies = everySky(elevation, turbidity, measured);
    const PreethamSky preetham = preethamSky(turbidity, elevation);
    const std::vector<double> nm = {340, 450, 550, 650, 740, 900};
    for (int i = 0; i < 40; ++i) {
      Vec3d direction = Vec3d(normal(random), normal(random), normal(random)).normalized();
      if (i == 0) direction = Vec3d(0, 1, 0);
      if (i == 1) direction = Vec3d(0, -1, 0);
      if (i == 2) direction = Vec3d(1, 0, 0);
      if (i == 3) direction = sunDirection(elevation);
      const Vec3d mirrored(direction.x(), direction.y(), -direction.z());
      for (size_t k = 0; k < skies.size(); ++k) {
        const double luminance = skies[k](direction);
        ASSERT_TRUE(std::isfinite(luminance) && luminance >= 0 && luminance < 1e7)
            << k << " gives " << luminance << " for a Sun at " << elevation / test::kDegree;
        ASSERT_NEAR(skies[k](mirrored), luminance, 1e-9 * luminance + 1e-12) << k;
      }
      const radiometry::Xyzv color = preetham.color(direction);
      ASSERT_TRUE(color.isFinite().all() && (color >= 0).all()) << color.transpose();
      for (const double power : preetham.spectrum(direction, nm)) {
        ASSERT_TRUE(std::isfinite(power) && power >= 0);
      }
    }
  }
}

TEST(EverySky, NoStepsWhileTheSunSets) {
  const Vec3d direction = Vec3d(.4, .5, .3).normalized();
  const MeasuredIrradiance measured{300, 100};
  auto before = everySky(2 * test::kDegree, 3, measured);
  for (double elevation = 1.9; elevation > -18; elevation -= .1) {
    auto now = everySky(elevation * test::kDegree, 3, measured);
    for (size_t k = 0; k < now.size(); ++k) {
      const double ratio = now[k](direction) / before[k](direction);
      ASSERT_TRUE(ratio > .85 && ratio < 1.1) << k << " at " << elevation << ": " << ratio;
    }
    before = std::move(now);
  }
}

TEST(AnalyticDome, ColourAndSpectrumAgree) {
  const auto overcast = cieOvercast(.6);
  const auto dome = daylightDome([overcast](const Vec3d& d) { return overcast.luminance(d); });
  const auto blue = preethamDome(preethamSky(2.5, .6));
  std::vector<double> nm;
  for (double at = 340; at <= 740; at += 10) nm.push_back(at);
  std::vector<double> spectrum(nm.size());
  for (const auto& sky : {dome, blue}) {
    const Vec3d direction = Vec3d(-.2, .7, .4).normalized();
    sky->spectrum(direction, nm, spectrum);
    const radiometry::Xyzv seen = radiometry::xyzvOf(nm, spectrum);
    const radiometry::Xyzv expected = sky->color(direction);
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(seen[k] / expected[k], 1, 3e-3) << k;
    }
  }
}

}  // namespace
}  // namespace lambent::sky
