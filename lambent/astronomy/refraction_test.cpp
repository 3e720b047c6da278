#include "lambent/astronomy/refraction.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "lambent/astronomy/test_sky.h"

namespace lambent::astronomy {
namespace {

/// bennett1982calculation: from the apparent elevation in degrees, minutes of arc, 283 K, 101 kPa.
double bennett(double apparent) {
  return 1 / std::tan((apparent + 7.31 / (apparent + 4.4)) * kDegree);
}

TEST(Refraction, IsTheInverseOfBennetts) {
  for (double h = -0.6; h <= 90; h += 0.1) {
    const double lift = refraction(h * kDegree) / kMinute;
    EXPECT_NEAR(lift, bennett(h + lift / 60), 0.1) << h;
  }
}

TEST(Refraction, HorizonAnd45DegreesAndZenith) {
  // What is seen at the horizon stands 34.5′ below it.
  EXPECT_NEAR(refracted({0, -34.5 * kMinute}).elevation / kMinute, 0, 0.1);
  EXPECT_NEAR(refraction(45 * kDegree) / kMinute, 1.0, 0.02);
  EXPECT_NEAR(refraction(90 * kDegree), 0, 1e-9);
}

TEST(Refraction, FollowsTheDensityOfTheAir) {
  const double reference = refraction(0.1);
  EXPECT_NEAR(refraction(0.1, {283, 50500}), reference / 2, 1e-15);
  EXPECT_NEAR(refraction(0.1, {2 * 283.0, 101000}), reference / 2, 1e-15);
  EXPECT_EQ(refraction(0.1, {283, 0}), 0);
}

TEST(Refraction, RisesWithoutStepsThroughTheHorizon) {
  for (const auto& [air, step] : {std::pair{Air{}, 0.005 * kDegree},
                                  {Air{}, 0.02 * kDegree},
                                  {Air{200, 110000}, 0.005 * kDegree}}) {
    double before[3] = {};
    double secondBefore = 0;
    int count = 0;
    for (double h = -kPi / 2; h <= kPi / 2; h += step, ++count) {
      const double lift = refraction(h, air);
      ASSERT_TRUE(std::isfinite(lift));
      ASSERT_GE(lift, -1e-11);
      ASSERT_LT(lift, 90 * kMinute);
      if (count > 0) {
        ASSERT_GT(h + lift, h - step + before[0]) << h / kDegree;
        if (h > -1 * kDegree) {
          ASSERT_LT(lift, before[0]) << h / kDegree;
        }
      }
      if (count > 1) {
        const double second = (lift - 2 * before[0] + before[1]) / (step * step);
        // What changes the curvature is its slope: less in smaller steps.
        if (count > 2) {
          ASSERT_NEAR(second, secondBefore, 100 * step / kDegree) << h / kDegree;
        }
        secondBefore = second;
      }
      before[1] = before[0];
      before[0] = lift;
    }
  }
}

TEST(Refraction, FadesOutBelowTheHorizon) {
  EXPECT_LT(refraction(-18 * kDegree), 0.01 * kMinute);
  EXPECT_LT(refraction(-6 * kDegree), 10 * kMinute);
}

TEST(Air, StandardAtmosphere) {
  // U.S. Standard Atmosphere 1976, geopotential altitudes.
  EXPECT_NEAR(standardAir(0).pressure, 101325, 1e-9);
  EXPECT_NEAR(standardAir(5000).pressure, 54020, 5);
  EXPECT_NEAR(standardAir(5000).temperature, 255.65, 1e-9);
  EXPECT_NEAR(standardAir(11000).pressure, 22632, 3);
  EXPECT_NEAR(standardAir(20000).pressure, 5474.9, 2);
}

TEST(Air, IsRefusedOutOfRange) {
  EXPECT_TRUE(airFromCelsius(11, 820));
  EXPECT_FALSE(airFromCelsius(-300, 820));
  EXPECT_FALSE(airFromCelsius(std::nan(""), 820));
  EXPECT_FALSE(airFromCelsius(11, -1));
  EXPECT_FALSE(airFromCelsius(11, std::nan("")));
}

}  // namespace
}  // namespace lambent::astronomy
