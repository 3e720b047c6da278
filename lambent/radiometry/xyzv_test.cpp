#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lambent/radiometry/luminance.h"
#include "lambent/radiometry/spectra.h"

namespace lambent::radiometry {
namespace {

std::vector<double> wavelengths(double first, double last, double step) {
  std::vector<double> nm;
  for (int i = 0; first + step * i <= last + 1e-9; ++i) {
    nm.push_back(first + step * i);
  }
  return nm;
}

template <class F>
Xyzv xyzvOfFunction(const std::vector<double>& nm, const F& f) {
  std::vector<double> values(nm.size());
  std::transform(nm.begin(), nm.end(), values.begin(), f);
  return xyzvOf(nm, values);
}

TEST(Xyzv, EqualEnergyIsWhite) {
  const Xyzv white = xyzvOfFunction(wavelengths(360, 830, 10), [](double) { return 1.0; });
  const double sum = white.head<3>().sum();
  EXPECT_NEAR(white[0] / sum, 1. / 3, 1e-4);
  EXPECT_NEAR(white[1] / sum, 1. / 3, 1e-4);
  // ∫ȳ = 106.857 nm, ∫V′ = 97.07 nm (its table of 1 nm).
  EXPECT_NEAR(white[1], 683.002 * 106.857, 2);
  EXPECT_NEAR(white[3] / kScotopicEfficacy, 97.07, .05);
}

TEST(Xyzv, VisibleRangeHoldsAllButTenThousandths) {
  const auto flat = [](double) { return 1.0; };
  const Xyzv all = xyzvOfFunction(wavelengths(360, 830, 10), flat);
  const Xyzv visible = xyzvOfFunction(wavelengths(380, 740, 10), flat);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(visible[k] / all[k], 1, k == 0 || k == 2 ? 5e-4 : 1e-4) << k;
  }
}

TEST(Xyzv, ExactForSpectraLinearBetweenTheirSamples) {
  // The same broken line, sampled at its four corners or at many places between as well.
  const std::vector<double> corners = {391.3, 447, 512.75, 701.2};
  const std::vector<double> values = {.3, 1.7, .2, .9};
  const auto line = [&](double nm) {
    size_t i = 0;
    while (i + 2 < corners.size() && nm > corners[i + 1]) {
      ++i;
    }
    const double t = (nm - corners[i]) / (corners[i + 1] - corners[i]);
    return (1 - t) * values[i] + t * values[i + 1];
  };
  std::vector<double> dense;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    for (int k = 0; k < 37; ++k) {
      dense.push_back(corners[i] + (corners[i + 1] - corners[i]) * k / 37.);
    }
  }
  dense.push_back(corners.back());
  const Xyzv few = xyzvOf(corners, values), many = xyzvOfFunction(dense, line);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(few[k] / many[k], 1, 1e-12) << k;
  }
  // And against a sum of a million terms.
  Xyzv sum = Xyzv::Zero();
  const int terms = 200000;
  const double step = (corners.back() - corners.front()) / terms;
  for (int i = 0; i < terms; ++i) {
    const double nm = corners.front() + step * (i + .5);
    const Vec3d cie = cie1931(nm);
    sum += step * line(nm) *
           Xyzv(kPhotopicEfficacy * cie[0], kPhotopicEfficacy * cie[1], kPhotopicEfficacy * cie[2],
                kScotopicEfficacy * scotopicEfficiency(nm));
  }
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(few[k] / sum[k], 1, 1e-7) << k;
  }
}

TEST(Xyzv, OneSampleWeighsNothing) {
  EXPECT_TRUE(xyzvOf(std::vector<double>{550}, std::vector<double>{1}).isZero());
  EXPECT_EQ(xyzvWeights({}).cols(), 0);
}

TEST(Xyzv, SunOutsideOfTheAtmosphere) {
  const Xyzv sun = xyzvOfFunction(wavelengths(360, 830, 10), solarIrradiance);
  // Published: 133.1 klx for the extraterrestrial spectrum of this table.
  EXPECT_NEAR(sun[1], 133.1e3, .5e3);
  EXPECT_NEAR(sun[0] / sun.head<3>().sum(), .323, .002);
  EXPECT_NEAR(sun[1] / sun.head<3>().sum(), .333, .002);
}

TEST(Xyzv, PlanckAtTheTemperatureOfIlluminantA) {
  // Illuminant A: 2855.54 K with c₂ = 1.4388 cm K has x, y = .44758, .40745
  // (sums of products at 5 nm, where we integrate the product of two broken lines).
  const Xyzv a = xyzvOfFunction(wavelengths(360, 830, 5), [](double nm) {
    return std::pow(560 / nm, 5) * std::expm1(1.4388e7 / (2855.54 * 560)) /
           std::expm1(1.4388e7 / (2855.54 * nm));
  });
  EXPECT_NEAR(a[0] / a.head<3>().sum(), .44758, 5e-5);
  EXPECT_NEAR(a[1] / a.head<3>().sum(), .40745, 5e-5);
}

TEST(LinearRgb, WhiteAndLuminance) {
  const Xyzv d65 = daylightXyzv(.3127, .3290, 683.002);
  const Eigen::Array3d white = linearRgbOf(d65);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(white[c], 1, 2e-4) << c;
  }
  const Eigen::Array3d colour = linearRgbOf(Xyzv(3, 5, 11, 0));
  EXPECT_NEAR(683.002 * (.2126 * colour[0] + .7152 * colour[1] + .0722 * colour[2]), 5, 1e-12);
}

TEST(Magnitudes, OfKnownSkies) {
  EXPECT_NEAR(magnitudesPerSquareArcsecond(1), 12.58, 1e-12);
  EXPECT_NEAR(magnitudesPerSquareArcsecond(1.7e-4), 22.0, .01);  // the darkest natural night
  EXPECT_TRUE(std::isinf(magnitudesPerSquareArcsecond(0)));
}

}  // namespace
}  // namespace lambent::radiometry
