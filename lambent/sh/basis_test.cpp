#include "lambent/sh/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "lambent/math/sequences.h"
#include "lambent/sh/projection.h"

namespace lambent::sh {
namespace {

// The conventions, as a table: index, name, and the function written out. Signs are positive, the
// polar axis is z, the index is l(l+1)+m from 0.
struct Row {
  int index;
  const char* name;
  double (*value)(double x, double y, double z);
};
const Row kTable[] = {
    {0, "Y00", [](double, double, double) { return std::sqrt(1 / (4 * kPi)); }},
    {1, "Y1-1", [](double, double y, double) { return std::sqrt(3 / (4 * kPi)) * y; }},
    {2, "Y10", [](double, double, double z) { return std::sqrt(3 / (4 * kPi)) * z; }},
    {3, "Y11", [](double x, double, double) { return std::sqrt(3 / (4 * kPi)) * x; }},
    {4, "Y2-2", [](double x, double y, double) { return std::sqrt(15 / (4 * kPi)) * x * y; }},
    {5, "Y2-1", [](double, double y, double z) { return std::sqrt(15 / (4 * kPi)) * y * z; }},
    {6, "Y20",
     [](double, double, double z) { return std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1); }},
    {7, "Y21", [](double x, double, double z) { return std::sqrt(15 / (4 * kPi)) * x * z; }},
    {8, "Y22",
     [](double x, double y, double) { return std::sqrt(15 / (16 * kPi)) * (x * x - y * y); }},
};

std::vector<Vec3> directions(int count) {
  std::vector<Vec3> d = math::sphericalFibonacci(count);
  for (int axis = 0; axis < 3; ++axis)
    for (float sign : {-1.0f, 1.0f}) d.push_back(sign * Vec3::Unit(axis));
  return d;
}

TEST(Basis, FirstNineFunctionsAreThoseOfTheTable) {
  for (const Vec3& d : directions(50)) {
    const Vec3d s = d.cast<double>();
    std::vector<double> y(9);
    std::vector<float> yf(9);
    evaluate(3, s, y);
    evaluate(3, d, yf);
    for (const Row& row : kTable) {
      EXPECT_NEAR(y[row.index], row.value(s.x(), s.y(), s.z()), 1e-6) << row.name;
      EXPECT_NEAR(yf[row.index], y[row.index], 5e-7) << row.name;
    }
  }
  EXPECT_NEAR(kTable[3].value(1, 0, 0), 0.488603, 1e-6);
}

TEST(Basis, FunctionsWithPositiveOrderRiseTowardsX) {
  // Near the pole, on the side of +x (m > 0) or a little off it towards +y (m < 0), every function
  // is positive: a Condon-Shortley sign would show at odd |m|.
  const Vec3d s = Vec3d(std::cos(0.1), std::sin(0.1), 10).normalized();
  std::vector<double> y(100);
  evaluate(10, s, y);
  for (int i = 0; i < 100; ++i) EXPECT_GT(y[i], 0) << i;
}

TEST(Basis, IsOrthonormal) {
  for (int bands : {5, 10, 32}) {
    const int count = coefficientCount(bands);
    // Any random combination g of the functions comes back as itself.
    std::vector<double> g(count), y(count);
    for (int i = 0; i < count; ++i) g[i] = std::sin(1.7 * i + 1);
    const std::vector<double> back = project(
        bands,
        [&](const Vec3d& s) {
          evaluate(bands, s, y);
          double sum = 0;
          for (int i = 0; i < count; ++i) sum += g[i] * y[i];
          return sum;
        },
        bands);
    for (int i = 0; i < count; ++i) EXPECT_NEAR(back[i], g[i], 1e-12) << bands << " " << i;
  }
  std::vector<double> y(100);
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> row = project(
        10,
        [&](const Vec3d& s) {
          evaluate(10, s, y);
          return y[i];
        },
        10);
    for (int j = 0; j < 100; ++j) EXPECT_NEAR(row[j], i == j ? 1 : 0, 1e-12);
  }
}

TEST(Basis, SinglePrecisionFollowsDouble) {
  for (int bands = 1; bands <= kMaxBands; ++bands) {
    const int count = coefficientCount(bands);
    std::vector<double> y(count);
    std::vector<float> yf(count + 1, 77.0f);
    double worst = 0;
    for (const Vec3& d : directions(2000)) {
      evaluate(bands, Vec3d(d.cast<double>()), y);
      evaluate(bands, d, std::span(yf).first(count));
      for (int i = 0; i < count; ++i) worst = std::max(worst, std::abs(yf[i] - y[i]));
    }
    EXPECT_LT(worst, 2.5e-7 * bands) << bands;
    EXPECT_EQ(yf[count], 77.0f) << "wrote past the end with " << bands << " bands";
  }
}

TEST(Basis, AdditionTheoremHolds) {
  // Σ_m y_lm(s)² = (2l+1)/4π in every direction.
  std::vector<double> y(coefficientCount(32));
  for (const Vec3& d : directions(20)) {
    evaluate(32, Vec3d(d.cast<double>().normalized()), y);
    for (int l = 0; l < 32; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += y[index(l, m)] * y[index(l, m)];
      EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPi), 1e-11);
    }
  }
}

TEST(Basis, ReconstructionSumsTheFunctions) {
  const Vec3 s = Vec3(1, -2, 3).normalized();
  for (int bands : {1, 4, 10}) {
    RgbCoefficients f(bands);
    for (std::size_t i = 0; i < f.values.size(); ++i) f.values[i] = std::cos(float(i));
    std::vector<double> y(coefficientCount(bands));
    evaluate(bands, Vec3d(s.cast<double>()), y);
    const Rgb rgb = reconstruct(f, s);
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int i = 0; i < coefficientCount(bands); ++i) sum += f.channel(c)[i] * y[i];
      EXPECT_NEAR(reconstruct(std::as_const(f).channel(c), s), sum, 1e-5);
      EXPECT_NEAR(rgb[c], sum, 1e-5);
    }
  }
}

TEST(Basis, ParsevalHolds) {
  // ∫ f² = Σ f_i² for a band-limited f.
  const std::vector<double> f{1, -2, 0.5, 3, 0.25, -1, 2, 0, 1.5};
  std::vector<double> y(9);
  const double root = std::sqrt(4 * kPi);  // y₀₀ = 1/√4π: the mean coefficient is the integral/√4π
  const std::vector<double> square = project(
      1,
      [&](const Vec3d& s) {
        evaluate(3, s, y);
        double sum = 0;
        for (int i = 0; i < 9; ++i) sum += f[i] * y[i];
        return sum * sum;
      },
      8);
  double expected = 0;
  for (double v : f) expected += v * v;
  EXPECT_NEAR(square[0] * root, expected, 1e-12);
}

TEST(Coefficients, IndicesAreABijection) {
  int next = 0;
  for (int l = 0; l < 32; ++l)
    for (int m = -l; m <= l; ++m, ++next) {
      EXPECT_EQ(index(l, m), next);
      EXPECT_EQ(bandOf(next), l);
    }
  EXPECT_EQ(next, coefficientCount(32));
  EXPECT_EQ(bandsOf(25), 5);
  EXPECT_EQ(bandsOf(0), 0);
}

TEST(Coefficients, BandsAreCutAndFilled) {
  RgbCoefficients f(3);
  for (std::size_t i = 0; i < f.values.size(); ++i) f.values[i] = float(i + 1);
  const RgbCoefficients cut = withBands(f, 2), filled = withBands(f, 4);
  ASSERT_EQ(cut.values.size(), 12u);
  ASSERT_EQ(filled.values.size(), 48u);
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 16; ++i) EXPECT_EQ(filled.channel(c)[i], i < 9 ? 9 * c + i + 1 : 0);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(cut.channel(c)[i], 9 * c + i + 1);
  }
}

}  // namespace
}  // namespace lambent::sh
