#include "lambent/sky/sky_light.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"

namespace lambent::sky {
namespace {

/// Steep at the horizon, and with a cusp at the Sun.
class TestDome final : public Dome {
 public:
  explicit TestDome(double sunElevation)
      : sun_(std::cos(sunElevation), std::sin(sunElevation), 0) {}
  radiometry::Xyzv color(const Vec3d& s) const override {
    const double elevation = std::asin(std::clamp(s.y(), -1.0, 1.0));
    const double fromSun = std::acos(std::clamp(s.dot(sun_), -1.0, 1.0));
    const double y = 2000 * (1 + std::exp(-elevation / 0.1)) * (1 + 8 * std::exp(-3 * fromSun));
    return radiometry::Xyzv(0.9 * y, y, (1.3 + 0.4 * s.y()) * y, y);
  }
  void spectrum(const Vec3d&, std::span<const double>, std::span<double> radiance) const override {
    for (double& each : radiance) each = 0;
  }

 private:
  Vec3d sun_;
};

/// The Sun's frame turned to a compass bearing.
Mat3d towards(double bearing) {
  Mat3d worldFromSun;
  worldFromSun.col(0) = Vec3d(std::sin(bearing), 0, -std::cos(bearing));
  worldFromSun.col(1) = Vec3d::UnitY();
  worldFromSun.col(2) = worldFromSun.col(0).cross(Vec3d::UnitY());
  return worldFromSun;
}

Sky skyOf(double elevation, double visible = 1, double horizon = 0) {
  Sky sky;
  sky.dome = std::make_shared<TestDome>(elevation);
  sky.sun = {.elevation = elevation,
             .angularRadius = 0.00465,
             .visible = visible,
             .irradiance = radiometry::Xyzv(80000, 85000, 75000, 80000),
             .spectralIrradiance = {}};
  sky.horizon = horizon;
  sky.ground = radiometry::Xyzv(900, 1000, 1100, 1000);
  return sky;
}

TEST(SkyLight, StandsWhereTheWorldHasIt) {
  const double elevation = 0.5, bearing = 2.0;
  const light::Environment light = environmentOf(skyOf(elevation), towards(bearing));
  const auto at = [](double b, double e) {
    return Vec3d(std::cos(e) * std::sin(b), std::sin(e), -std::cos(e) * std::cos(b))
        .cast<float>()
        .eval();
  };
  // The Sun's disc is some 10⁴ times as bright as the sky beside it.
  EXPECT_GT(light.radiance(at(bearing, elevation))[1], 1e5f);
  EXPECT_LT(light.radiance(at(bearing, elevation + 0.005))[1], 1e2f);
  EXPECT_LT(light.radiance(at(bearing + 0.006, elevation))[1], 1e2f);
  // Luminance comes back: of the dome in that direction of its own frame, and of the ground.
  const auto luminance = [&](const Vec3& s) {
    const Rgb c = light.radiance(s);
    return radiometry::kPhotopicEfficacy *
           (0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]));
  };
  const TestDome dome(elevation);
  for (const double b : {0.0, 1.0, 3.0, 5.0})
    for (const double e : {0.001, 0.3, 1.2}) {
      const Vec3d inSun(std::cos(e) * std::cos(b - bearing), std::sin(e),
                        std::cos(e) * std::sin(b - bearing));
      EXPECT_NEAR(luminance(at(b, e)) / dome.color(inSun)[1], 1, 2e-5);
      EXPECT_NEAR(luminance(at(b, -e)), 1000, 0.05);
    }
}

TEST(SkyLight, HasTheSunsIlluminance) {
  for (const double elevation : {0.7, 0.002}) {
    const Sky sky = skyOf(elevation, elevation > 0.01 ? 1 : 0.7);
    const auto with = environmentOf(sky, towards(1)).project(2);
    Sky without = sky;
    without.sun.visible = 0;
    const auto dark = environmentOf(without, towards(1)).project(2);
    double y = 0;
    for (int c = 0; c < 3; ++c)
      y += (c == 0   ? 0.2126
            : c == 1 ? 0.7152
                     : 0.0722) *
           double(with.channel(c)[0] - dark.channel(c)[0]) * std::sqrt(4 * kPi);
    EXPECT_NEAR(y * radiometry::kPhotopicEfficacy / 85000, 1, 1e-4) << elevation;
  }
}

TEST(SkyLight, ProjectsTheDomeAboveTheHorizon) {
  for (const double horizon : {0.0, -0.06}) {
    const TestDome dome(0.6);
    const std::vector<double> f = projectDome(dome, horizon, 10);
    // By many more directions, and with the Sun's cusp between two rules.
    std::vector<double> sum(100), y(100);
    for (const auto& [low, high] : {std::pair(horizon, 0.6), std::pair(0.6, kPi / 2)}) {
      const math::Quadrature rise = math::gaussLegendre(160, low, high);
      const math::Quadrature turn = math::gaussLegendre(200, 0, kPi);
      for (std::size_t j = 0; j < rise.nodes.size(); ++j)
        for (std::size_t i = 0; i < turn.nodes.size(); ++i)
          for (const double side : {-1.0, 1.0}) {
            const double e = rise.nodes[j], a = side * turn.nodes[i];
            const Vec3d s(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
            const double value = rise.weights[j] * turn.weights[i] * std::cos(e) * dome.color(s)[1];
            sh::evaluate(10, s, std::span<double>(y));
            for (std::size_t k = 0; k < 100; ++k) sum[k] += value * y[k];
          }
    }
    for (std::size_t k = 0; k < 100; ++k) EXPECT_NEAR(f[100 + k], sum[k], 1e-3 * sum[0]) << k;
    EXPECT_NEAR(f[100], sum[0], 2e-4 * sum[0]);
  }
}

// The disc comes up over two thirds of a degree; what it lights grows on as the sky does.
TEST(SkyLight, RisesWithoutAStep) {
  std::vector<sh::RgbCoefficients> lights;
  for (int k = -60; k <= 60; ++k) {
    const double elevation = 0.01 * k * kPi / 180, radius = 0.00465;
    const double height = std::clamp(elevation / radius, -1.0, 1.0);
    const double visible =
        0.5 + (std::asin(height) + height * std::sqrt(1 - height * height)) / kPi;
    Sky sky = skyOf(elevation, visible);
    sky.sun.irradiance *= 0.05 * visible;
    lights.push_back(environmentOf(sky, towards(1)).project(5));
  }
  for (std::size_t k = 1; k + 1 < lights.size(); ++k) {
    double largest = 0, bend = 0;
    for (std::size_t i = 0; i < lights[k].values.size(); ++i) {
      const double now = double(lights[k].values[i]);
      const double mean = (double(lights[k - 1].values[i]) + double(lights[k + 1].values[i])) / 2;
      largest = std::max(largest, std::abs(now));
      bend = std::max(bend, std::abs(now - mean));
    }
    EXPECT_LT(bend, 1e-3 * largest) << int(k) - 60;
  }
}

TEST(SkyLight, DarkensTowardsTheLimbAsTheSunDoes) {
  const Rgb u = solarLimbDarkening();
  // The mean of μ^.508 over the disc, at 550 nm; .008 below that of the usual quadratic law, .3 +
  // .93 μ − .23 μ².
  EXPECT_NEAR(1 - double(u[1]) / 3, 2 / 2.508, 0.001);
  EXPECT_NEAR(1 - double(u[1]) / 3, 0.3 + 0.62 - 0.115, 0.01);
  EXPECT_TRUE(u[0] < u[1] && u[1] < u[2]);
  EXPECT_GT(u[0], 0.5f);
  EXPECT_LT(u[2], 0.75f);
}

}  // namespace
}  // namespace lambent::sky
