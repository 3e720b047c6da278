// Discs that are darker towards the limb, and cut by a horizon: environment_test.cpp holds them to
// what every light must do; here is what their formulas say.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/light/environment.h"
#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/math/statistics.h"
#include "lambent/sh/basis.h"

namespace lambent::light {
namespace {

constexpr double kDiameter = 0.0093;
const Rgb kIrradiance(300, 500, 200);
const Rgb kDarkening(0.5f, 0.6f, 0.7f);

Vec3 aimed(double azimuth, double elevation) {
  return math::directionFromAzimuthElevation(azimuth, elevation).cast<float>();
}

/// On a surface that faces `direction`, by drawing.
Eigen::Array3d irradianceByDrawing(const Environment& light, const Vec3& direction, int draws,
                                   double* error) {
  math::Random random(3, 1);
  math::RunningMoments sum[3];
  for (int n = 0; n < draws; ++n) {
    const Environment::Sample s = light.sample(random.uniform(), random.uniform());
    for (int c = 0; c < 3; ++c)
      sum[c].add(double(s.radianceOverPdf[c]) * std::max(0.0, double(s.direction.dot(direction))));
  }
  *error = std::max({sum[0].standardError(), sum[1].standardError(), sum[2].standardError()});
  return {sum[0].mean(), sum[1].mean(), sum[2].mean()};
}

TEST(DarkenedDisc, HasTheIrradianceThatWasAsked) {
  const Vec3 direction = aimed(0.7, 0.4);
  const Environment sun = Environment::disc({.direction = direction,
                                             .angularDiameter = kDiameter,
                                             .irradiance = kIrradiance,
                                             .darkening = kDarkening});
  double error;
  const Eigen::Array3d drawn = irradianceByDrawing(sun, direction, 40000, &error);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], double(kIrradiance[c]), 5 * error + 1e-3);
  // ∫ cos L ds is the projection on y₁ turned there.
  const sh::RgbCoefficients f = sun.project(2);
  for (int c = 0; c < 3; ++c) {
    const auto y = f.channel(c);
    const double linear =
        std::sqrt(4 * kPi / 3) *
        double(y[1] * direction.y() + y[2] * direction.z() + y[3] * direction.x());
    EXPECT_NEAR(linear, double(kIrradiance[c]), 2e-6 * double(kIrradiance[c]));
  }
}

TEST(DarkenedDisc, IsAsDarkAtTheLimbAsTheLawSays) {
  const Environment sun = Environment::disc({.direction = Vec3::UnitX(),
                                             .angularDiameter = 0.2,
                                             .irradiance = kIrradiance,
                                             .darkening = kDarkening});
  const Rgb center = sun.radiance(Vec3::UnitX());
  for (const double share : {0.0, 0.3, 0.7, 0.95, 0.999}) {
    const double angle = 0.1 * share;
    const double mu = std::sqrt(1 - (1 - std::cos(angle)) / (1 - std::cos(0.1)));
    EXPECT_NEAR(mu, std::sqrt(1 - share * share), 1e-3);
    const Rgb there = sun.radiance(Vec3(float(std::cos(angle)), float(std::sin(angle)), 0));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(there[c] / center[c], 1 - double(kDarkening[c]) * (1 - mu), 1e-3) << share;
  }
  EXPECT_EQ(sun.radiance(Vec3(std::cos(0.1001f), std::sin(0.1001f), 0))[0], 0.0f);
}

TEST(DarkenedDisc, WithoutDarkeningIsThePlainDisc) {
  const Vec3 direction = aimed(2, -0.3);
  const Environment sun = Environment::disc(
      {.direction = direction, .angularDiameter = 0.15, .irradiance = Rgb::Ones()});
  const Environment plain = Environment::disc(
      direction, 0.15, Rgb::Constant(float(1 / (kPi * std::pow(std::sin(0.075), 2)))));
  const auto a = sun.project(10), b = plain.project(10);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], 1e-6f) << i;
  EXPECT_NEAR(sun.radiance(direction)[1], plain.radiance(direction)[1], 1e-4);
  EXPECT_NEAR(sun.pdf(direction), plain.pdf(direction), 1e-4f * plain.pdf(direction));
}

/// In polar coordinates about the disc's axis, with the rim and the square root at it resolved by
/// μ as variable.
std::vector<double> momentsByQuadrature(double half, double darkening, int bands) {
  std::vector<double> moments(std::size_t(bands), 0.0);
  const math::Quadrature rule = math::gaussLegendre(400, 0, half);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    // θ from the limb inwards: w² = half − θ.
    const double w = rule.nodes[i] / std::sqrt(half);
    const double theta = half - w * w;
    const double t = std::pow(std::sin(theta / 2) / std::sin(half / 2), 2);
    const double value = (1 - darkening * (1 - std::sqrt(1 - t))) * std::sin(theta) * 2 * w *
                         rule.weights[i] / std::sqrt(half);
    for (int l = 0; l < bands; ++l)
      moments[std::size_t(l)] += 2 * kPi * value * std::legendre(unsigned(l), std::cos(theta));
  }
  return moments;
}

TEST(DarkenedDisc, ProjectsByMomentsOfTheLaw) {
  for (const double half : {0.00465, 0.1}) {
    const Environment sun = Environment::disc({.direction = Vec3::UnitZ(),
                                               .angularDiameter = 2 * half,
                                               .irradiance = Rgb::Ones(),
                                               .darkening = Rgb(0, 0.6f, 1)});
    const auto f = sun.project(10);
    for (int c = 0; c < 3; ++c) {
      const double u = c == 0 ? 0.0 : c == 1 ? double(0.6f) : 1.0;
      const auto moments = momentsByQuadrature(half, u, 10);
      for (int l = 0; l < 10; ++l)
        EXPECT_NEAR(f.channel(c)[sh::index(l, 0)],
                    std::sqrt((2 * l + 1) / (4 * kPi)) * moments[l] / moments[1], 2e-6)
            << half << " " << l;
    }
  }
}

TEST(CutDisc, HasTheIrradianceOfWhatIsSeen) {
  for (const double share : {-0.9, -0.3, 0.0, 0.6, 0.999})
    for (const double horizon : {-0.05, 0.0, 0.3}) {
      const Vec3 direction = aimed(-2, horizon + share * kDiameter / 2);
      const Environment sun = Environment::disc({.direction = direction,
                                                 .angularDiameter = kDiameter,
                                                 .irradiance = kIrradiance,
                                                 .darkening = kDarkening,
                                                 .horizon = horizon});
      double error;
      const Eigen::Array3d drawn = irradianceByDrawing(sun, direction, 100000, &error);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(drawn[c], double(kIrradiance[c]), 5 * error) << share << " " << horizon;
      const auto f = sun.project(1);
      EXPECT_NEAR(f.channel(0)[0] * std::sqrt(4 * kPi), kIrradiance[0], 2e-5 * kIrradiance[0]);
    }
}

TEST(CutDisc, ShowsNothingBelowTheHorizon) {
  const Environment sun = Environment::disc({.direction = aimed(1, 0.001),
                                             .angularDiameter = kDiameter,
                                             .irradiance = kIrradiance,
                                             .horizon = 0});
  EXPECT_GT(sun.radiance(aimed(1, 1e-6))[0], 0);
  EXPECT_EQ(sun.radiance(aimed(1, -1e-6))[0], 0);
  // The half disc: 4/3π of the radius above the horizon is its mean elevation.
  const Environment half = Environment::disc({.direction = aimed(0, 0),
                                              .angularDiameter = kDiameter,
                                              .irradiance = Rgb::Ones(),
                                              .horizon = 0});
  EXPECT_NEAR(half.project(2).channel(1)[1] / std::sqrt(3 / (4 * kPi)),
              4 / (3 * kPi) * kDiameter / 2, 1e-7);
}

TEST(CutDisc, RisesWithoutAStep) {
  // What a full disc of one radiance gives as it rises: its share of the whole.
  const auto seen = [](double elevation) {
    const Environment sun = Environment::disc({.direction = aimed(0, elevation),
                                               .angularDiameter = kDiameter,
                                               .irradiance = Rgb::Ones(),
                                               .darkening = kDarkening,
                                               .horizon = 0});
    const Environment::Parts parts = sun.parts();
    return parts.discs.empty() ? 0.0 : 1 / double(parts.discs[0].radiance[1]);
  };
  double last = 0, lastStep = 0;
  for (int k = -101; k <= 101; ++k) {
    const double now = seen(k * kDiameter / 200) / seen(1);
    EXPECT_GE(now, last - 1e-6) << k;
    EXPECT_LT(std::abs(now - last - lastStep), 4e-4) << k;
    lastStep = now - last;
    last = now;
  }
  EXPECT_NEAR(last, 1, 1e-6);
}

TEST(CutDisc, TurnsWithItsHorizon) {
  const Mat3 turn = math::randomRotation(4);
  const Environment sun = Environment::disc({.direction = aimed(1, 0),
                                             .angularDiameter = kDiameter,
                                             .irradiance = kIrradiance,
                                             .horizon = 0});
  const Environment turned = sun.rotated(turn);
  for (const double e : {-0.004, -0.0001, 0.0001, 0.004})
    EXPECT_EQ(turned.radiance(turn * aimed(1, e))[1] > 0, e > 0) << e;
}

}  // namespace
}  // namespace lambent::light
