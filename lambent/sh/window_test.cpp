#include "lambent/sh/window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::sh {
namespace {

/// Σ (2l+1)/4π w_l P_l(t): a delta, windowed, at the angle whose cosine is t.
double windowedDelta(const std::vector<double>& window, double t) {
  double sum = 0;
  for (std::size_t l = 0; l < window.size(); ++l)
    sum += (2.0 * l + 1) / (4 * kPi) * window[l] * std::legendre(unsigned(l), t);
  return sum;
}

double leastOverPeak(const std::vector<double>& window) {
  double least = 1e9;
  for (int i = 0; i <= 20000; ++i) least = std::min(least, windowedDelta(window, i / 10000.0 - 1));
  return least / windowedDelta(window, 1);
}

RgbCoefficients inEveryChannel(int bands, const std::vector<float>& f) {
  RgbCoefficients rgb(bands);
  for (int c = 0; c < 3; ++c) std::copy(f.begin(), f.end(), rgb.channel(c).begin());
  return rgb;
}

struct Range {
  double least, peak;
};

Range range(const RgbCoefficients& f, int samples) {
  Range r{1e30, 0};
  for (const Vec3& s : math::sphericalFibonacci(samples)) {
    const Rgb value = reconstruct(f, s);
    r.least = std::min(r.least, double(value.minCoeff()));
    r.peak = std::max(r.peak, double(value.maxCoeff()));
  }
  return r;
}

/// Three lights of so many radians at least over a dim sky, of different colours.
RgbCoefficients smallLights(int bands, std::uint64_t seed, double leastHalfAngle) {
  math::Random random(seed, std::uint64_t(bands));
  RgbCoefficients f(bands);
  std::vector<float> lobe(coefficientCount(bands));
  for (int light = 0; light < 3; ++light) {
    turnTo(cap(bands, leastHalfAngle + 0.5 * random.uniform()),
           Vec3(math::randomRotation(random.bits()).col(2)), lobe);
    for (int c = 0; c < 3; ++c) {
      const float power = random.uniform();
      for (std::size_t i = 0; i < lobe.size(); ++i) f.channel(c)[i] += power * lobe[i];
    }
  }
  for (int c = 0; c < 3; ++c) f.channel(c)[0] += 0.01f;
  return f;
}

TEST(Window, KnownMinimaOfAFiveBandDelta) {
  EXPECT_NEAR(leastOverPeak(std::vector<double>(5, 1.0)), -.1517, 5e-5);
  EXPECT_NEAR(leastOverPeak(hann(5, 5)), -.0381, 5e-5);
  EXPECT_NEAR(leastOverPeak(lanczos(5, 5)), -.0560, 5e-5);
}

TEST(Window, ClosedFormsStartAtOneAndEndAtTheirWidth) {
  for (double width : {3.0, 5.0, 7.5}) {
    const std::vector<double> h = hann(10, width), s = lanczos(10, width);
    EXPECT_EQ(h[0], 1);
    EXPECT_EQ(s[0], 1);
    for (int l = 1; l < 10; ++l) {
      EXPECT_NEAR(h[l], l < width ? std::pow(std::cos(kPi * l / width / 2), 2) : 0, 1e-15);
      EXPECT_LE(s[l], s[l - 1]);
      if (l >= width) {
        EXPECT_EQ(s[l], 0);
      }
    }
  }
  EXPECT_NEAR(hann(5, 4)[2], 0.5, 1e-15);
  EXPECT_NEAR(lanczos(5, 4)[2], 2 / kPi, 1e-15);
}

TEST(Window, MultipliesEachBandOfEachChannel) {
  RgbCoefficients f(3);
  std::fill(f.values.begin(), f.values.end(), 1.0f);
  applyWindow({1, 0.5, 0.25, 9}, f);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 9; ++i) EXPECT_EQ(f.channel(c)[i], i == 0 ? 1 : i < 4 ? 0.5f : 0.25f);
}

TEST(MinimalRinging, LeavesWhatDoesNotRing) {
  std::vector<float> f(25);
  turnTo(ZonalMoments{1, 0.25, 0.05, 0.005, 0.0005}, Vec3(Vec3::UnitX()), f);
  EXPECT_EQ(minimalRinging(inEveryChannel(5, f)), std::vector<double>(5, 1.0));
  EXPECT_EQ(minimalRinging(RgbCoefficients(4)), std::vector<double>(4, 1.0));
}

TEST(MinimalRinging, IsNonNegativeAndNoMoreThanNeeded) {
  for (int bands : {2, 3, 5, 7, 10})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const RgbCoefficients f = smallLights(bands, seed, 0.1);
      const std::vector<double> window = minimalRinging(f);
      ASSERT_EQ(window[0], 1);
      RgbCoefficients windowed = f;
      applyWindow(window, windowed);
      const Range r = range(windowed, 40000);
      EXPECT_GE(r.least, -1e-6 * r.peak) << bands << " bands";
      // It touches zero: the least attenuation that will do.
      if (window[1] < 1) {
        EXPECT_LE(r.least, 2e-3 * r.peak) << bands << " bands";
      }
      // The family: 1/w − 1 goes as l²(l+1)².
      for (int l = 2; l < bands; ++l)
        EXPECT_NEAR((1 / window[l] - 1) / (1 / window[1] - 1), std::pow(l * (l + 1) / 2.0, 2),
                    1e-6 * std::pow(l * (l + 1) / 2.0, 2));
    }
}

TEST(MinimalRinging, OfADeltaIsThatOfTheOneDimensionalSearch) {
  // A delta is zonal: its minimum can be searched along one angle, apart from the code under test.
  double low = 0, high = 1;
  const auto family = [](double lambda) {
    std::vector<double> window;
    for (int l = 0; l < 5; ++l) window.push_back(1 / (1 + lambda * std::pow(l * (l + 1.0), 2)));
    return window;
  };
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (leastOverPeak(family(middle)) >= 0 ? high : low) = middle;
  }
  std::vector<float> f(25);
  turnTo(delta(5), Vec3(Vec3(0.2f, -0.7f, 0.4f).normalized()), f);
  const std::vector<double> window = minimalRinging(inEveryChannel(5, f));
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(window[l], family(high)[l], 1e-5);
}

TEST(MinimalRinging, DoesNotDependOnTheFrame) {
  std::vector<float> f(25), g(25);
  turnTo(delta(5), Vec3(Vec3::UnitZ()), f);
  turnTo(delta(5), Vec3(Vec3(0.6f, 0, -0.8f)), g);
  const std::vector<double> a = minimalRinging(inEveryChannel(5, f)),
                            b = minimalRinging(inEveryChannel(5, g));
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(a[l], b[l], 1e-5);
}

TEST(MinimalRinging, KeepsTheMeanAloneWhereNothingElseHelps) {
  RgbCoefficients f(3);
  for (int c = 0; c < 3; ++c) f.channel(c)[0] = -1;
  f.channel(1)[3] = 1;
  EXPECT_EQ(minimalRinging(f), (std::vector<double>{1, 0, 0}));
}

TEST(LeastSoftening, LeavesWhatDoesNotRing) {
  std::vector<float> f(25);
  turnTo(ZonalMoments{1, 0.25, 0.05, 0.005, 0.0005}, Vec3(Vec3::UnitX()), f);
  EXPECT_EQ(leastSoftening(inEveryChannel(5, f)), std::vector<double>(5, 1.0));
  EXPECT_EQ(leastSoftening(RgbCoefficients(4)), std::vector<double>(4, 1.0));
  EXPECT_EQ(leastSoftening(henyeyGreenstein(10, 0.4)), std::vector<double>(10, 1.0));
}

TEST(LeastSoftening, OfADeltaIsTheSharpestNonNegativeAndKeepsMoreThanMinimalRinging) {
  std::vector<float> f(25);
  turnTo(delta(5), Vec3(Vec3(0.2f, -0.7f, 0.4f).normalized()), f);
  const std::vector<double> window = leastSoftening(inEveryChannel(5, f));
  const std::vector<double> minimal = minimalRinging(inEveryChannel(5, f));
  for (std::size_t l = 1; l < 5; ++l) {
    EXPECT_NEAR(window[l], sharpestNonNegative(5)[l], 0.03);
    EXPECT_GT(window[l], minimal[l] + 0.05);
  }
  const std::vector<double> ofLobe = leastSoftening(delta(5));
  for (std::size_t l = 1; l < 5; ++l) EXPECT_NEAR(ofLobe[l], sharpestNonNegative(5)[l], 0.03);
}

TEST(LeastSoftening, LeavesNoneOfSeveralSmallLightsNegative) {
  for (int bands : {2, 3, 4, 5, 7, 10})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const RgbCoefficients f = smallLights(bands, seed, 0.05);
      RgbCoefficients windowed = f;
      applyWindow(leastSoftening(f), windowed);
      const Range r = range(windowed, 40000);
      EXPECT_GE(r.least, -5e-3 * r.peak) << bands << " bands";
    }
}

TEST(LeastSoftening, OfALobeIsTheSameAsOfTheLightThatItWouldBe) {
  for (double exponent : {2.0, 12.0, 80.0}) {
    std::vector<float> f(36);
    turnTo(phongLobe(6, exponent), Vec3(Vec3(0.2f, -0.7f, 0.4f).normalized()), f);
    const std::vector<double> light = leastSoftening(inEveryChannel(6, f));
    const std::vector<double> lobe = leastSoftening(phongLobe(6, exponent));
    for (std::size_t l = 0; l < 6; ++l) EXPECT_NEAR(light[l], lobe[l], 0.02) << exponent;
  }
}

}  // namespace
}  // namespace lambent::sh
