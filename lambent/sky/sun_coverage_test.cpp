#include "lambent/sky/sun_coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lambent::sky {
namespace {

constexpr double kRadius = 0.00465;

SunDisc discAt(double elevation) {
  SunDisc sun;
  sun.elevation = elevation;
  sun.angularRadius = kRadius;
  return sun;
}

/// Around the Sun's centre, in radii of its disc: x to the right, y up.
class Around {
 public:
  explicit Around(double elevation)
      : centre_(std::cos(elevation), std::sin(elevation), 0),
        up_(-std::sin(elevation), std::cos(elevation), 0) {}

  Vec3d operator()(double x, double y) const {
    const double rho = std::hypot(x, y);
    if (rho == 0) return centre_;
    // Equal areas: 2 sin(θ/2) is proportional to ρ.
    const double theta = 2 * std::asin(rho * std::sin(kRadius / 2));
    const Vec3d side = (x * Vec3d::UnitZ() + y * up_) / rho;
    return std::cos(theta) * centre_ + std::sin(theta) * side;
  }
  std::vector<Vec3d> box(double x0, double y0, double x1, double y1) const {
    return {(*this)(x0, y0), (*this)(x1, y0), (*this)(x1, y1), (*this)(x0, y1)};
  }

 private:
  Vec3d centre_, up_;
};

std::vector<double> sharesOf(const SunCoverage& coverage, const std::vector<Vec3d>& outline,
                             size_t count) {
  std::vector<double> shares(count);
  coverage.shares(outline, shares);
  return shares;
}

TEST(LimbDarkening, IsWhatObserversFit) {
  EXPECT_NEAR(limbDarkening(550), 0.508, 5e-4);
  EXPECT_NEAR(limbDarkening(372), 0.678, 1e-3);
  EXPECT_NEAR(limbDarkening(416), 0.679, 1e-3);
  for (double nm = 340; nm < 740; nm += 1)
    EXPECT_NEAR(limbDarkening(nm), limbDarkening(nm + 1), 5e-3) << nm;
  // Mean over centre 1/(1 + α/2): .80 at 550 nm (cox2000allen, table 14.17, .2 above 0).
  EXPECT_NEAR(1 / (1 + limbDarkening(550) / 2), 0.80, 0.01);
}

TEST(SunCoverage, WholeHalfQuarterAndNone) {
  const std::vector<double> exponents{0, 0.5, 0.8};
  for (const double elevation : {0.3, 1.2, kPi / 2}) {
    const SunCoverage coverage(discAt(elevation), 0, exponents);
    ASSERT_TRUE(coverage.isVisible());
    const Around around(elevation);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(sharesOf(coverage, around.box(-1.5, -1.5, 1.5, 1.5), 3)[i], 1, 1e-12);
      EXPECT_NEAR(sharesOf(coverage, around.box(-1.5, -1.5, 0, 1.5), 3)[i], 0.5, 1e-9);
      EXPECT_NEAR(sharesOf(coverage, around.box(0, 0, 1.5, 1.5), 3)[i], 0.25, 1e-9);
      EXPECT_EQ(sharesOf(coverage, around.box(1.01, -1, 3, 3), 3)[i], 0);
      EXPECT_EQ(sharesOf(coverage, around.box(50, 50, 60, 60), 3)[i], 0);
    }
    // The other way round, the same.
    std::vector<Vec3d> turned = around.box(0, 0, 1.5, 1.5);
    std::reverse(turned.begin(), turned.end());
    EXPECT_NEAR(sharesOf(coverage, turned, 3)[1], 0.25, 1e-9);
  }
}

TEST(SunCoverage, AnEvenDiscIsASegmentOfACircle) {
  const SunCoverage coverage(discAt(0.7), 0, {0});
  const Around around(0.7);
  for (const double x : {-0.9, -0.3, 0.0, 0.45, 0.999}) {
    const double segment = std::acos(x) - x * std::sqrt(1 - x * x);  // right of x
    EXPECT_NEAR(sharesOf(coverage, around.box(x, -2, 2, 2), 1)[0], segment / kPi, 1e-9) << x;
  }
}

TEST(SunCoverage, ADarkenedDiscIsTheSumOfItsPoints) {
  const double exponent = 0.6;
  const SunCoverage coverage(discAt(0.7), 0, {exponent});
  const Around around(0.7);
  const double x0 = -0.2, y0 = 0.1, x1 = 0.75, y1 = 0.9;  // crosses the limb
  double sum = 0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = x0 + (i + 0.5) / kSteps * (x1 - x0), y = y0 + (j + 0.5) / kSteps * (y1 - y0);
      const double mu2 = 1 - x * x - y * y;
      if (mu2 > 0) sum += std::pow(mu2, exponent / 2);
    }
  }
  const double part = sum * (x1 - x0) * (y1 - y0) / (double(kSteps) * kSteps);
  const double whole = 2 * kPi / (2 + exponent);
  EXPECT_NEAR(sharesOf(coverage, around.box(x0, y0, x1, y1), 1)[0], part / whole, 2e-6);
}

TEST(SunCoverage, TheHorizonCutsTheDisc) {
  // Its centre stands a third of a radius above the horizon.
  const double elevation = kRadius / 3;
  const SunCoverage coverage(discAt(elevation), 0, {0, 0.6});
  const Around around(elevation);
  const auto all = sharesOf(coverage, around.box(-2, -2, 2, 2), 2);
  EXPECT_NEAR(all[0], 1, 1e-12);
  EXPECT_NEAR(all[1], 1, 1e-12);
  EXPECT_EQ(sharesOf(coverage, around.box(-2, -2, 2, -0.34), 2)[0], 0);
  const double x = -1.0 / 3, visible = kPi - (std::acos(-x) + x * std::sqrt(1 - x * x));
  const double upper = std::acos(0.5) - 0.5 * std::sqrt(0.75);
  EXPECT_NEAR(sharesOf(coverage, around.box(-2, 0.5, 2, 2), 2)[0], upper / visible, 1e-6);

  EXPECT_FALSE(SunCoverage(discAt(-1.01 * kRadius), 0, {0}).isVisible());
  EXPECT_TRUE(SunCoverage(discAt(-0.99 * kRadius), 0, {0}).isVisible());
  EXPECT_TRUE(SunCoverage(discAt(-0.02), -0.03, {0}).isVisible());
  SunDisc gone = discAt(0.1);
  gone.visible = 0;
  EXPECT_FALSE(SunCoverage(gone, 0, {0}).isVisible());
}

TEST(SunCoverage, DensityIsTheShareOfASmallPatch) {
  for (const double elevation : {0.7, kRadius / 3}) {
    const SunCoverage coverage(discAt(elevation), 0, {0, 0.6});
    const Around around(elevation);
    const double side = 1e-3, angle = std::pow(side * 2 * std::sin(kRadius / 2), 2);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.5, 0.3}, {-0.2, 0.9}}) {
      std::vector<double> densities(2);
      coverage.densities(around(x, y), densities);
      const auto patch =
          sharesOf(coverage, around.box(x - side / 2, y - side / 2, x + side / 2, y + side / 2), 2);
      for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(densities[i] * angle / patch[i], 1, 1e-4);
    }
    std::vector<double> densities(2, 1.0);
    coverage.densities(around(0.8, 0.61), densities);
    EXPECT_EQ(densities[1], 0);
  }
  std::vector<double> densities(1, 1.0);
  SunCoverage(discAt(kRadius / 3), 0, {0}).densities(Around(kRadius / 3)(0, -0.5), densities);
  EXPECT_EQ(densities[0], 0);
}

}  // namespace
}  // namespace lambent::sky
