#include "lambent/radiometry/spectra.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lambent::radiometry {
namespace {

TEST(SolarIrradiance, AsPublishedComparisonsHaveIt) {
  EXPECT_NEAR(solarIrradianceOfComparisons(450), 2.01449, 1e-5);
  EXPECT_NEAR(solarIrradianceOfComparisons(550), 1.84687, 1e-5);
  EXPECT_NEAR(solarIrradianceOfComparisons(650), 1.54572, 1e-5);
  EXPECT_NEAR(solarIrradianceOfComparisons(720), 1.33778, 1e-5);
  EXPECT_DOUBLE_EQ(solarIrradianceOfComparisons(100), solarIrradianceOfComparisons(336.5));
}

TEST(SolarIrradiance, BothTablesHoldTheSamePower) {
  double own = 0, ofComparisons = 0;
  for (double nm = 400; nm < 700; ++nm) {
    own += solarIrradiance(nm + .5);
    ofComparisons += solarIrradianceOfComparisons(nm + .5 - 11.75 / 2);
  }
  // The integral of the table at its own resolution, 400 … 700 nm; the band about 400 nm holds a
  // step.
  EXPECT_NEAR(own, 529.96, 1.5);
  EXPECT_NEAR(ofComparisons / own, 1, 2e-3);
}

TEST(Penndorf, KnownCoefficientsAndTheirPower) {
  EXPECT_NEAR(penndorf15C(450), .0264382e-3, 1e-10);
  EXPECT_NEAR(penndorf15C(550), .0116218e-3, 1e-10);
  EXPECT_NEAR(penndorf15C(650), .00589338e-3, 1e-11);
  EXPECT_NEAR(penndorf15C(720), .00389511e-3, 1e-11);
  EXPECT_NEAR(penndorf15C(400), 4.30e-5, 5e-8);
  // A little steeper than λ⁻⁴, as the refractive index falls with wavelength; without a step where
  // the rows that were computed meet those of the table.
  for (double nm = 330; nm < 800; nm += 10) {
    const double exponent =
        -std::log(penndorf15C(nm + 10) / penndorf15C(nm)) / std::log((nm + 10) / nm);
    EXPECT_NEAR(exponent, 4.15, .2) << nm;
  }
}

TEST(Ozone, ThreeHundredDobsonUnits) {
  const double column = 300 * kDobsonUnit;
  EXPECT_NEAR(column * ozoneCrossSection(600), .04, .002);
  EXPECT_LT(column * ozoneCrossSection(400), 5e-4);
  for (double nm = 340; nm <= 740; nm += 5) {
    EXPECT_GE(ozoneCrossSection(nm), 0) << nm;
    EXPECT_LE(ozoneCrossSection(nm), ozoneCrossSection(605)) << nm;
  }
}

TEST(Observers, PeaksAndEnds) {
  EXPECT_DOUBLE_EQ(cie1931(555)[1], 1);
  EXPECT_DOUBLE_EQ(cie1931(600)[0], 1.0622);
  EXPECT_TRUE(cie1931(359.9).isZero());
  EXPECT_TRUE(cie1931(830.1).isZero());
  double peak = 0, at = 0;
  for (double nm = 300; nm < 900; ++nm) {
    if (scotopicEfficiency(nm) > peak) {
      peak = scotopicEfficiency(nm);
      at = nm;
    }
  }
  EXPECT_NEAR(at, 507, 2.5);  // entries stand 5 nm apart
  EXPECT_NEAR(peak, 1, 3e-3);
  EXPECT_DOUBLE_EQ(scotopicEfficiency(379), 0);
  // The definition of the candela fixes both efficacies at 555 nm: 683.
  EXPECT_NEAR(kScotopicEfficacy * scotopicEfficiency(555.016), 683, .6);
}

}  // namespace
}  // namespace lambent::radiometry
