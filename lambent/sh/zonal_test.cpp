#include "lambent/sh/zonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/projection.h"
#include "lambent/sh/rotation.h"

namespace lambent::sh {
namespace {

/// 2π ∫ h P_l between two cosines, by a rule that is exact for polynomials.
ZonalMoments byQuadrature(int bands, double low, double high, double (*h)(double, double),
                          double parameter) {
  ZonalMoments moments(bands, 0.0);
  const math::Quadrature rule = math::gaussLegendre(400, low, high);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int l = 0; l < bands; ++l)
      moments[l] += 2 * kPi * rule.weights[i] * h(rule.nodes[i], parameter) *
                    std::legendre(unsigned(l), rule.nodes[i]);
  return moments;
}

/// The projection coefficient h_l0 of a moment.
double projected(const ZonalMoments& moments, int l) {
  return std::sqrt((2 * l + 1) / (4 * kPi)) * moments[l];
}

void expectNear(const ZonalMoments& a, const ZonalMoments& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t l = 0; l < a.size(); ++l) EXPECT_NEAR(a[l], b[l], tolerance) << "band " << l;
}

TEST(Zonal, ClampedCosineHasItsClosedForm) {
  const ZonalMoments m = clampedCosine(10);
  const double expected[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64, 0};
  for (int l = 0; l < 8; ++l) EXPECT_NEAR(m[l], expected[l], 1e-14);
  EXPECT_NEAR(m[6], 0.049087, 1e-6);
  const double known[] = {.886227, 1.023327, .495416, 0, -.110778};
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(projected(m, l), known[l], 1e-6);
  expectNear(m,
             byQuadrature(
                 10, 0, 1, [](double t, double) { return t; }, 0),
             1e-12);
  EXPECT_EQ(clampedCosine(1), ZonalMoments{kPi});
}

TEST(Zonal, CapHasItsClosedForm) {
  for (double angle : {0.00465, 0.1, kPi / 6, 1.0, kPi / 2, 2.5, kPi}) {
    const ZonalMoments m = cap(10, angle);
    const double c = std::cos(angle);
    EXPECT_NEAR(projected(m, 0), std::sqrt(kPi) * (1 - c), 1e-13);
    for (unsigned l = 1; l < 10; ++l)
      EXPECT_NEAR(projected(m, int(l)),
                  std::sqrt((2 * l + 1) * kPi) *
                      (std::legendre(l - 1, c) - std::legendre(l + 1, c)) / (2 * l + 1),
                  1e-13);
  }
  const double thirtyDegrees[] = {.237464, .383748, .429043, .403002, .323787};
  const ZonalMoments m = cap(5, kPi / 6);
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(projected(m, l), thirtyDegrees[l], 1e-6);
}

TEST(Zonal, NarrowCapKeepsItsDigits) {
  // As the angle goes to 0, every moment goes to the solid angle: 1 − O(α²) of it.
  const double angle = 1e-7;
  const ZonalMoments m = cap(10, angle);
  for (int l = 0; l < 10; ++l) EXPECT_NEAR(m[l] / (kPi * angle * angle), 1, 1e-12);
}

TEST(Zonal, HemisphereIsTheCapOfARightAngle) {
  expectNear(hemisphere(10), cap(10, kPi / 2), 1e-14);
  expectNear(hemisphere(10),
             byQuadrature(
                 10, 0, 1, [](double, double) { return 1.0; }, 0),
             1e-12);
  EXPECT_EQ(hemisphere(3)[2], 0);
}

TEST(Zonal, PhongLobeFollowsItsRecurrence) {
  for (double r : {0.0, 1.0, 4.0, 10.5, 64.0, 1000.0})
    expectNear(
        phongLobe(10, r),
        byQuadrature(
            10, 0, 1, [](double t, double e) { return (e + 1) / (2 * kPi) * std::pow(t, e); }, r),
        1e-9);
  // Exponent 1 is the cosine over π.
  const ZonalMoments cosine = clampedCosine(10), lobe = phongLobe(10, 1);
  for (int l = 0; l < 10; ++l) EXPECT_NEAR(lobe[l], cosine[l] / kPi, 1e-14);
}

TEST(Zonal, HenyeyGreensteinHasPowersOfItsMeanCosine) {
  for (double g : {-0.5, 0.0, 0.3, 0.8})
    expectNear(henyeyGreenstein(8, g),
               byQuadrature(
                   8, -1, 1,
                   [](double t, double k) {
                     return (1 - k * k) / (4 * kPi * std::pow(1 + k * k - 2 * k * t, 1.5));
                   },
                   g),
               1e-11);
}

TEST(Zonal, QuadratureSeesNoKinkAtTheHorizon) {
  expectNear(zonal(10, [](double t) { return std::max(t, 0.0); }), clampedCosine(10), 1e-12);
  expectNear(
      zonal(10, [](double t) { return t > 0 ? 3 / kPi * t * t : 0; }),
      [] {
        ZonalMoments m = phongLobe(10, 2);
        for (double& v : m) v *= 2;
        return m;
      }(),
      1e-12);
}

TEST(Zonal, TurningAgreesWithRotation) {
  const ZonalMoments lobe = cap(8, 0.6);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Mat3 q = math::randomRotation(seed);
    std::vector<float> up(64), turned(64), rotated(64);
    turnTo(lobe, Vec3(Vec3::UnitZ()), up);
    turnTo(lobe, Vec3(q.col(2)), turned);
    rotate(8, q, up, rotated);
    for (int i = 0; i < 64; ++i) EXPECT_NEAR(turned[i], rotated[i], 1e-6);
  }
}

TEST(Zonal, TurnedLobeIsTheProjectionOfTheTurnedFunction) {
  const Vec3d axis = Vec3d(1, -2, 0.5).normalized();
  const std::vector<double> expected = project(
      6, [&](const Vec3d& s) { return std::exp(2 * s.dot(axis)); }, 40);
  std::vector<double> turned(36);
  turnTo(zonal(6, [](double t) { return std::exp(2 * t); }), axis, turned);
  for (int i = 0; i < 36; ++i) EXPECT_NEAR(turned[i], expected[i], 1e-12);
}

TEST(Zonal, ConvolutionIsTheIntegralOverTheSphere) {
  // (h * f)(s) = ∫ h(s·t) f(t) dt, with a smooth kernel.
  const auto kernel = [](double t) { return std::exp(3 * (t - 1)); };
  std::vector<float> f(36);
  math::Random random(3, 3);
  for (float& v : f) v = 2 * random.uniform() - 1;
  std::vector<float> convolved = f;
  convolve(zonal(6, kernel), convolved);
  std::vector<double> y(36);
  for (const Vec3d& s : {Vec3d(0, 0, 1), Vec3d(0.48, 0.64, -0.6), Vec3d(-0.6, 0, 0.8)}) {
    const double integral = project(
                                1,
                                [&](const Vec3d& t) {
                                  evaluate(6, t, y);
                                  double sum = 0;
                                  for (int i = 0; i < 36; ++i) sum += f[i] * y[i];
                                  return sum * kernel(s.dot(t));
                                },
                                40)[0] *
                            std::sqrt(4 * kPi);
    EXPECT_NEAR(reconstruct(convolved, Vec3(s.cast<float>())), integral, 3e-6);
  }
  std::vector<float> same = f;
  convolve(delta(6), same);
  EXPECT_EQ(same, f);
}

/// Σ (2l+1)/4π ĥ_l P_l(t).
double at(const ZonalMoments& moments, double t) {
  double sum = 0;
  for (std::size_t l = 0; l < moments.size(); ++l)
    sum += (2.0 * double(l) + 1) / (4 * kPi) * moments[l] * std::legendre(unsigned(l), t);
  return sum;
}

TEST(SharpestNonNegative, HasTheRootsThatItMustHave) {
  EXPECT_EQ(sharpestNonNegative(1), ZonalMoments{1});
  EXPECT_NEAR(sharpestNonNegative(2)[1], 1.0 / 3, 1e-12);
  EXPECT_NEAR(sharpestNonNegative(3)[1], std::sqrt(1.0 / 3), 1e-12);
  EXPECT_NEAR(sharpestNonNegative(3)[2], 0.2, 1e-12);
  EXPECT_NEAR(sharpestNonNegative(4)[1], (1 + std::sqrt(6.0)) / 5, 1e-12);  // Radau's
  EXPECT_NEAR(sharpestNonNegative(5)[1], std::sqrt(0.6), 1e-12);
}

TEST(SharpestNonNegative, IsNowhereNegativeAndNothingNonNegativeIsSharper) {
  for (int bands = 1; bands <= 10; ++bands) {
    const ZonalMoments moments = sharpestNonNegative(bands);
    EXPECT_EQ(moments[0], 1);
    for (int i = 0; i <= 2000; ++i)
      ASSERT_GE(at(moments, i / 1000.0 - 1), -1e-12) << bands << " bands";
    // Whatever else is non-negative: squares of polynomials, of random ones here.
    math::Random random(1, std::uint64_t(bands));
    for (int trial = 0; trial < 20 && bands >= 3; ++trial) {
      std::array<double, 5> a;
      for (double& each : a) each = 2 * random.uniform() - 1;
      const ZonalMoments other = zonal(bands, [&](double t) {
        double p = 0;
        for (int k = (bands - 1) / 2; k >= 0; --k) p = p * t + a[std::size_t(k)];
        return p * p;
      });
      EXPECT_LE(other[1] / other[0], moments[1] + 1e-12) << bands << " bands";
    }
  }
}

TEST(Zonal, FewerCoefficientsThanMomentsConvolveToo) {
  std::vector<float> f{1, 1, 1, 1};
  convolve(ZonalMoments{2, 3, 5, 7}, f);
  EXPECT_EQ(f, (std::vector<float>{2, 3, 3, 3}));
}

}  // namespace
}  // namespace lambent::sh
