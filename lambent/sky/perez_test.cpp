#include "lambent/sky/perez.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/sky/air_mass.h"
#include "lambent/sky/asrc_cie.h"
#include "lambent/sky/dome_quadrature.h"
#include "lambent/sky/test_angles.h"

namespace lambent::sky {
namespace {

template <class Sky>
double diffuseOf(const Sky& sky) {
  return onHorizontalPlane([&](const Vec3d& s) { return sky.luminance(s); });
}

TEST(Perez, AnchorOfGendaylit) {
  const PerezCoefficients k = perezCoefficients(clearnessBin(3), .2, 45 * test::kDegree);
  EXPECT_NEAR(k.a, -.881569, 1e-6);
  EXPECT_NEAR(k.b, -.370816, 1e-6);
  EXPECT_NEAR(k.c, 12.972025, 1e-6);
  EXPECT_NEAR(k.d, -3.453020, 1e-6);
  EXPECT_NEAR(k.e, .232467, 1e-6);
}

// a₁ … a₄, b₁ … e₄ of the eight rows.
constexpr double kPerezRows[8][20] = {
    {1.3525, -0.2576, -0.2690, -1.4366, -0.7670, 0.0007, 1.2734, -0.1233, 2.8000,  0.6004,
     1.2375, 1.000,   1.8734,  0.6297,  0.9738,  0.2809, 0.0356, -0.1246, -0.5718, 0.9938},
    {-1.2219, -0.7730, 1.4148,  1.1016,  -0.2054, 0.0367, -3.9128, 0.9156, 6.9750,  0.1774,
     6.4477,  -0.1239, -1.5798, -0.5081, -1.7812, 0.1080, 0.2624,  0.0672, -0.2190, -0.4285},
    {-1.1000,  -0.2515, 0.8952,  0.0156, 0.2782, -0.1812, -4.5000, 1.1766, 24.7219, -13.0812,
     -37.7000, 34.8438, -5.0000, 1.5218, 3.9229, -2.6204, -0.0156, 0.1597, 0.4199,  -0.5562},
    {-0.5484,  -0.6654, -0.2672, 0.7117, 0.7234, -0.6219, -5.6812, 2.6297,  33.3389, -18.3000,
     -62.2500, 52.0781, -3.5000, 0.0016, 1.1477, 0.1062,  0.4659,  -0.3296, -0.0876, -0.0329},
    {-0.6000,  -0.3566, -2.5000, 2.3250,  0.2937, 0.0496, -5.6812, 1.8415, 21.0000, -4.7656,
     -21.5906, 7.2492,  -3.5000, -0.1554, 1.4062, 0.3988, 0.0032,  0.0766, -0.0656, -0.1294},
    {-1.0156, -0.3670, 1.0078,  1.4051,  0.2875,  -0.5328, -3.8500, 3.3750, 14.0000, -0.9999,
     -7.1406, 7.5469,  -3.4000, -0.1078, -1.0750, 1.5702,  -0.0672, 0.4016, 0.3017,  -0.4844},
    {-1.0000, 0.0211,  0.5025,  -0.5119, -0.3000, 0.1922, 0.7023, -1.6317, 19.0000, -5.0000,
     1.2438,  -1.9094, -4.0000, 0.0250,  0.3844,  0.2656, 1.0468, -0.3788, -2.4517, 1.4656},
    {-1.0500,  0.0289,  0.4260,  0.3590, -0.3250, 0.1156, 0.7781, 0.0025,  31.0625, -14.5000,
     -46.1148, 55.3750, -7.2312, 0.4050, 13.3500, 0.6234, 1.5000, -0.6426, 1.8564,  0.5636},
};

TEST(Perez, EveryRowOfTheTable) {
  for (int bin = 0; bin < 8; ++bin) {
    for (const double delta : {.2, .35, .5}) {
      for (const double z : {0., .7, 1.5}) {
        const PerezCoefficients k = perezCoefficients(bin, delta, z);
        const double got[5] = {k.a, k.b, k.c, k.d, k.e};
        for (int i = 0; i < 5; ++i) {
          const double* x = kPerezRows[bin] + 4 * i;
          double expected = x[0] + x[1] * z + delta * (x[2] + x[3] * z);
          if (bin == 0 && i == 2)
            expected = std::exp(std::pow(delta * (x[0] + x[1] * z), x[2])) - x[3];
          if (bin == 0 && i == 3)
            expected = -std::exp(delta * (x[0] + x[1] * z)) + x[2] + delta * x[3];
          EXPECT_NEAR(got[i], expected, 1e-12) << bin << " " << i;
        }
      }
    }
  }
}

TEST(Perez, GuardOfDim) {
  for (int bin = 0; bin < 8; ++bin) {
    const double a = perezCoefficients(bin, .05, 1).a, guarded = perezCoefficients(bin, .2, 1).a;
    EXPECT_EQ(a == guarded, bin >= 1 && bin <= 4) << bin;
  }
}

TEST(Perez, Bins) {
  EXPECT_EQ(clearnessBin(1), 0);
  EXPECT_EQ(clearnessBin(1.0649), 0);
  EXPECT_EQ(clearnessBin(1.065), 1);
  EXPECT_EQ(clearnessBin(3), 5);
  EXPECT_EQ(clearnessBin(6.2), 7);
  EXPECT_EQ(clearnessBin(12), 7);
}

TEST(Perez, ConditionOfMeasuredIrradiance) {
  const SkyCondition sky = skyCondition({800, 100}, 45 * test::kDegree);
  const double cubic = 1.041 * std::pow(45 * test::kDegree, 3);
  EXPECT_NEAR(sky.clearness, (9 + cubic) / (1 + cubic), 1e-12);
  EXPECT_NEAR(sky.brightness, kastenAirMass(45 * test::kDegree) * 100 / 1367, 1e-12);
  EXPECT_DOUBLE_EQ(skyCondition({0, 100}, .5).clearness, 1);
  EXPECT_DOUBLE_EQ(skyCondition({100, 0}, .5).clearness, 12);
  EXPECT_DOUBLE_EQ(skyCondition({0, 0}, .5).clearness, 1);
  EXPECT_DOUBLE_EQ(skyCondition({-5, -5}, .5).brightness, .01);
}

TEST(Perez, LevelIsTheDiffuseIlluminance) {
  for (const MeasuredIrradiance& measured :
       {MeasuredIrradiance{0, 120}, {250, 220}, {600, 150}, {850, 80}}) {
    for (const double elevation : {4., 30., 70.}) {
      const PerezSky sky = perezSky(measured, elevation * test::kDegree);
      EXPECT_NEAR(diffuseOf(sky) / sky.diffuseIlluminance, 1, 1e-12);
      // Daylight has 90 … 160 lm/W.
      const double efficacy = sky.diffuseIlluminance / measured.diffuseHorizontal;
      EXPECT_GT(efficacy, 90) << elevation;
      EXPECT_LT(efficacy, 170) << elevation;
      const AsrcSky mixture = asrcSky(measured, elevation * test::kDegree);
      EXPECT_NEAR(diffuseOf(mixture) / mixture.diffuseIlluminance, 1, 1e-12);
      EXPECT_DOUBLE_EQ(mixture.diffuseIlluminance, sky.diffuseIlluminance);
    }
  }
}

TEST(Perez, NoStepsBetweenRowsUnlessAsked) {
  // Along a line of direct irradiance every border of clearness is crossed.
  const Vec3d direction = Vec3d(-.3, .6, .5).normalized();
  const auto largestStep = [&](double blend) {
    PerezOptions options;
    options.blend = blend;
    double largest = 0, before = perezSky({0, 150}, .6, options).luminance(direction);
    for (double direct = .25; direct < 900; direct += .25) {
      const double now = perezSky({direct, 150}, .6, options).luminance(direction);
      largest = std::max(largest, std::abs(std::log(now / before)));
      before = now;
    }
    return largest;
  };
  EXPECT_LT(largestStep(.03), .02);
  EXPECT_GT(largestStep(0), .03);
}

TEST(Perez, AwayFromBordersBlendingChangesNothing) {
  PerezOptions steps;
  steps.blend = 0;
  const Vec3d direction = Vec3d(.3, .6, .5).normalized();
  const MeasuredIrradiance measured{330, 155};  // ε = 3 … 4
  ASSERT_EQ(clearnessBin(skyCondition(measured, .9).clearness), 4);
  EXPECT_DOUBLE_EQ(perezSky(measured, .9).luminance(direction),
                   perezSky(measured, .9, steps).luminance(direction));
}

TEST(AsrcCie, WeightsSumToOneAndOrderTheSkies) {
  for (double clearness = 1; clearness <= 12; clearness += .1) {
    for (double brightness = .01; brightness < .6; brightness += .05) {
      const AsrcWeights w = asrcWeights({clearness, brightness});
      EXPECT_NEAR(w.clear + w.turbid + w.intermediate + w.overcast, 1, 1e-12);
      EXPECT_TRUE(w.clear >= 0 && w.turbid >= 0 && w.intermediate >= 0 && w.overcast >= 0);
    }
  }
  EXPECT_DOUBLE_EQ(asrcWeights({1, .2}).overcast, 1);
  EXPECT_DOUBLE_EQ(asrcWeights({3, .2}).intermediate, 1);
  EXPECT_DOUBLE_EQ(asrcWeights({8, .05}).clear, 1);
  EXPECT_DOUBLE_EQ(asrcWeights({8, .4}).turbid, 1);
}

TEST(AsrcCie, IntermediateSkyAgainstItsZenithForm) {
  // The same sky with angles from the zenith, as gensky's F2 and skybright.cal have it in rounded
  // constants.
  for (const double sunZenith : {.3, .8, 1.3}) {
    for (const double eta : {0., .5, 1.2}) {
      const double cosGamma = std::cos(sunZenith) * std::cos(eta);  // at 90° of azimuth
      const auto form = [&](double zenith, double gamma) {
        return ((1.35 * std::sin(5.631 - 3.59 * zenith) + 3.12) *
                    std::sin(4.396 - 2.6 * sunZenith) +
                6.37 - zenith) /
               2.326 * std::exp(-.563 * gamma * ((2.629 - zenith) * (1.562 - sunZenith) + .812));
      };
      const Vec3d direction(0, std::cos(eta), std::sin(eta));
      const double expected = form(eta, std::acos(cosGamma)) / form(0, sunZenith);
      EXPECT_NEAR(intermediateRelativeLuminance(kPi / 2 - sunZenith, direction), expected,
                  5e-3 * expected);
    }
  }
}

}  // namespace
}  // namespace lambent::sky
