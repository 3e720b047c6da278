// Look-up, projection, sampling and rotation of every kind of light, held to closed forms and to
// each other.
#include "lambent/light/environment.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/light/grid_distribution.h"
#include "lambent/light/test_component.h"
#include "lambent/light/test_skylight.h"
#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/math/statistics.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/rotation.h"

namespace lambent::light {
namespace {

// Many z-values are looked at: 1,000 of them exceed this by chance once in 1,700 seeds.
constexpr double kLargestZ = 5.0;

double legendre(int l, double x) {
  return l < 0 ? 1.0 : std::legendre(unsigned(l), x);
}

image::Image randomImage(int width, int height, std::uint64_t seed) {
  math::Random random(seed, 0);
  image::Image image(width, height);
  for (Rgb& p : image.pixels) {
    // Mostly dark, some black, a few very bright: what environment maps are like.
    const float base = std::pow(random.uniform(), 8.0f) * 50;
    const bool black = random.uniform() < 0.3f;
    for (int c = 0; c < 3; ++c) p[c] = black ? 0.0f : base * random.uniform();
  }
  return image;
}

sh::RgbCoefficients randomHarmonics(int bands, std::uint64_t seed) {
  math::Random random(seed, 1);
  sh::RgbCoefficients f(bands);
  for (float& value : f.values) value = 2 * random.uniform() - 1;
  return f;
}

struct Case {
  std::string name;
  Environment light;
  double directional = 0;  ///< share of draws that goes to directional lights
};

std::vector<Case> allKinds() {
  const Vec3 a = Vec3(1, 2, -0.5f).normalized(), b = Vec3(-0.3f, -0.4f, 0.8f).normalized();
  const Mat3 turn = math::randomRotation(9);
  std::vector<Case> cases;
  cases.push_back({"uniform", Environment::uniform(Rgb(0.5f, 1, 2))});
  cases.push_back({"sun", Environment::disc(a, 0.0093, Rgb(3e4f, 2e4f, 1e4f))});
  cases.push_back({"disc", Environment::disc(b, 2.0, Rgb(1, 0.2f, 0))});
  cases.push_back({"whole disc", Environment::disc(b, 2 * kPi, Rgb(1, 0.2f, 0))});
  cases.push_back({"darkened sun", Environment::disc({.direction = a,
                                                      .angularDiameter = 0.0093,
                                                      .irradiance = Rgb(3, 2, 1),
                                                      .darkening = Rgb(0.5f, 0.6f, 1)})});
  cases.push_back({"setting sun", Environment::disc({.direction = Vec3(1, 0.01f, 1).normalized(),
                                                     .angularDiameter = 0.2,
                                                     .irradiance = Rgb(3, 2, 1),
                                                     .darkening = Rgb(0.5f, 0.6f, 0.7f),
                                                     .horizon = 0})});
  cases.push_back({"ground", Environment::ground(b, -0.2, Rgb(1, 0.2f, 0))});
  cases.push_back(
      {"sky", Environment::skylight(std::make_shared<test::Glow>(-0.1, Rgb(1, 2, 3)), turn)});
  cases.push_back(
      {"black sky", Environment::skylight(std::make_shared<test::Glow>(0, Rgb::Zero()), turn) +
                        Environment::ground(turn.col(1), 0, Rgb(1, 2, 3))});
  cases.push_back({"cosine", Environment::clampedCosine(a, Rgb(0, 1, 3))});
  cases.push_back({"harmonics", Environment::harmonics(randomHarmonics(5, 3))});
  cases.push_back({"image", Environment::latLong(randomImage(32, 16, 5))});
  cases.push_back({"turned image", Environment::latLong(randomImage(10, 5, 6)).rotated(turn)});
  cases.push_back({"one pixel", Environment::latLong(randomImage(1, 1, 12))});
  cases.push_back({"another room's",
                   Environment::of(std::make_shared<test::Gradient>(b, -0.9, Rgb(0.5f, 1, 2)))});
  cases.push_back({"sum", Environment::latLong(randomImage(16, 8, 7)) +
                              Environment::disc(a, 0.5, Rgb(10, 9, 8)) +
                              Environment::harmonics(randomHarmonics(3, 4)) +
                              Environment::uniform(Rgb::Constant(0.1f)) + Environment()});
  // Powers: 4π for the sky, 6 for the directional light, all grey.
  cases.push_back(
      {"with directional",
       Environment::uniform(Rgb::Ones()) + Environment::directional(a, Rgb::Constant(6.0f)),
       6 / (4 * kPi + 6)});
  return cases;
}

void expectNear(const sh::RgbCoefficients& a, const sh::RgbCoefficients& b, double tolerance,
                const std::string& what) {
  ASSERT_EQ(a.bands, b.bands);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], tolerance) << what << " [" << i << "]";
}

TEST(Projection, DiscIsTheCapOfLegendrePolynomials) {
  for (const double degrees : {0.53, 30.0, 60.0, 180.0, 300.0, 360.0}) {
    const double alpha = degrees / 2 * kPi / 180, x = std::cos(alpha);
    const auto f = Environment::disc(Vec3::UnitZ(), 2 * alpha, Rgb(1, 2, 3)).project(8);
    for (int l = 0; l < 8; ++l) {
      const double zonal =
          std::sqrt((2 * l + 1) * kPi) *
          (l == 0 ? 1 - x : (legendre(l - 1, x) - legendre(l + 1, x)) / (2 * l + 1));
      for (int m = -l; m <= l; ++m)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(f.channel(c)[sh::index(l, m)], m == 0 ? (c + 1) * zonal : 0.0,
                      1e-6 * (1 + std::abs(zonal)))
              << degrees << " l=" << l << " m=" << m;
    }
  }
}

TEST(Projection, OfAnAnalyticLightTurnsWithIt) {
  const Mat3 turn = math::randomRotation(21);
  const Vec3 axis = turn * Vec3::UnitZ();
  expectNear(Environment::disc(axis, 0.7, Rgb(1, 2, 3)).project(10),
             sh::rotate(turn, Environment::disc(Vec3::UnitZ(), 0.7, Rgb(1, 2, 3)).project(10)),
             5e-6, "disc");
  expectNear(Environment::clampedCosine(axis, Rgb(1, 2, 3)).project(10),
             sh::rotate(turn, Environment::clampedCosine(Vec3::UnitZ(), Rgb(1, 2, 3)).project(10)),
             5e-6, "cosine");
}

TEST(Projection, DirectionalIsTheBasisItself) {
  const Vec3 s = Vec3(0.2f, -0.5f, 0.7f).normalized();
  const auto f = Environment::directional(s, Rgb(1, 2, 4)).project(6);
  std::vector<double> y(36);
  sh::evaluate(6, s.cast<double>(), std::span<double>(y));
  for (int i = 0; i < 36; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(f.channel(c)[i], (1 << c) * y[i], 4e-6);
}

TEST(Projection, ClampedCosineAndUniform) {
  const auto cosine = Environment::clampedCosine(Vec3::UnitZ(), Rgb::Ones()).project(5);
  // h_l0 of max(cos, 0): √π/2, √(π/3), √(5π)/8, 0, −√π/16.
  const double expected[5] = {std::sqrt(kPi) / 2, std::sqrt(kPi / 3), std::sqrt(5 * kPi) / 8, 0,
                              -std::sqrt(kPi) / 16};
  for (int l = 0; l < 5; ++l) EXPECT_NEAR(cosine.channel(0)[sh::index(l, 0)], expected[l], 1e-6);
  const auto uniform = Environment::uniform(Rgb(1, 2, 3)).project(4);
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR(uniform.channel(1)[i], i == 0 ? 2 * std::sqrt(4 * kPi) : 0, 1e-6);
}

TEST(Projection, OfHarmonicsCutsOrFillsWithZeros) {
  const auto f = randomHarmonics(4, 8);
  const Environment light = Environment::harmonics(f);
  expectNear(light.project(6), sh::withBands(f, 6), 0, "more");
  expectNear(light.project(2), sh::withBands(f, 2), 0, "fewer");
}

/// ∫ radiance y ds over every patch between pixel centres, where radiance() is smooth.
sh::RgbCoefficients projectByQuadrature(const Environment& light, int width, int height,
                                        int bands) {
  const int count = sh::coefficientCount(bands);
  std::vector<double> sum(std::size_t(3) * count), y(count);
  std::vector<double> rows = {0};
  for (int j = 0; j < height; ++j) rows.push_back((j + 0.5) / height);
  rows.push_back(1);
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    const auto v = math::gaussLegendre(10, rows[r], rows[r + 1]);
    for (int i = 0; i < width; ++i) {
      const auto u = math::gaussLegendre(10, (i + 0.5) / width, (i + 1.5) / width);
      for (std::size_t a = 0; a < v.nodes.size(); ++a)
        for (std::size_t b = 0; b < u.nodes.size(); ++b) {
          const double elevation = kPi * (0.5 - v.nodes[a]), azimuth = 2 * kPi * (u.nodes[b] - 0.5);
          const Vec3d s(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                        std::cos(elevation) * std::sin(azimuth));
          const double weight = v.weights[a] * u.weights[b] * 2 * kPi * kPi * std::cos(elevation);
          const Rgb radiance = light.radiance(s.cast<float>());
          sh::evaluate(bands, s, std::span<double>(y));
          for (int c = 0; c < 3; ++c)
            for (int k = 0; k < count; ++k) sum[c * count + k] += weight * radiance[c] * y[k];
        }
    }
  }
  sh::RgbCoefficients out(bands);
  for (std::size_t i = 0; i < sum.size(); ++i) out.values[i] = float(sum[i]);
  return out;
}

TEST(Projection, OfAnImageIsThatOfItsLookUp) {
  for (const auto& [width, height] : {std::pair(12, 6), std::pair(8, 1), std::pair(3, 4)}) {
    const Environment light = Environment::latLong(randomImage(width, height, 17));
    const auto expected = projectByQuadrature(light, width, height, 6);
    expectNear(light.project(6), expected, 2e-5 * 4 * kPi * 50 / 10, "image");
  }
}

TEST(Projection, IsLinearInSums) {
  const Environment a = Environment::latLong(randomImage(8, 4, 1));
  const Environment b = Environment::disc(Vec3::UnitX(), 1, Rgb(1, 2, 3));
  const auto sum = (a + b).project(5);
  const auto fa = a.project(5), fb = b.project(5);
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    EXPECT_NEAR(sum.values[i], fa.values[i] + fb.values[i], 1e-5);
}

TEST(LookUp, FollowsTheConvention) {
  image::Image image(8, 4);
  image.at(5, 0) = Rgb(1, 2, 3);
  const Environment light = Environment::latLong(image);
  const auto at = [](double u, double v) {
    const double azimuth = 2 * kPi * (u - 0.5), elevation = kPi * (0.5 - v);
    return Vec3d(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                 std::cos(elevation) * std::sin(azimuth))
        .cast<float>()
        .eval();
  };
  EXPECT_TRUE(light.radiance(at(5.5 / 8, 0.5 / 4)).isApprox(Rgb(1, 2, 3), 1e-5f));
  EXPECT_TRUE(light.radiance(at(6.0 / 8, 0.5 / 4)).isApprox(Rgb(0.5f, 1, 1.5f), 1e-5f));
  EXPECT_TRUE(light.radiance(at(5.5 / 8, 1.0 / 4)).isApprox(Rgb(0.5f, 1, 1.5f), 1e-5f));
  EXPECT_TRUE(light.radiance(at(5.5 / 8, 0.1 / 4)).isApprox(Rgb(1, 2, 3), 1e-5f));  // half pixel
  EXPECT_NEAR(light.radiance(at(5.5 / 8, 2.5 / 4)).abs().maxCoeff(), 0, 1e-6);
  // u = atan2(z, x)/2π + ½: +x is the middle column, +z three quarters, +y the top.
  image::Image axes(4, 2);
  for (int x = 0; x < 4; ++x) axes.at(x, 0) = axes.at(x, 1) = Rgb::Constant(float(x));
  const Environment ramp = Environment::latLong(axes);
  EXPECT_NEAR(ramp.radiance(Vec3::UnitX())[0], 1.5, 1e-5);
  EXPECT_NEAR(ramp.radiance(Vec3::UnitZ())[0], 2.5, 1e-5);
  EXPECT_NEAR(ramp.radiance(-Vec3::UnitZ())[0], 0.5, 1e-5);
  EXPECT_NEAR(ramp.radiance(-Vec3::UnitX())[0], 1.5, 1e-5);  // between column 3 and column 0
}

TEST(LookUp, DiscOfAnyDiameter) {
  const Vec3 axis = Vec3(1, 1, 0).normalized();
  for (const double degrees : {0.5, 90.0, 180.0, 359.0}) {
    const double half = degrees / 2 * kPi / 180;
    const Environment disc = Environment::disc(axis, 2 * half, Rgb::Ones());
    for (const double side : {-1.0, 1.0}) {
      const double angle = half * (1 + side * 1e-3);
      if (angle > kPi) continue;
      const Vec3 s = float(std::cos(angle)) * axis + float(std::sin(angle)) * Vec3::UnitZ();
      EXPECT_EQ(disc.radiance(s)[0], side < 0 ? 1.0f : 0.0f) << degrees;
    }
  }
  EXPECT_EQ(Environment::disc(axis, 2 * kPi, Rgb::Ones()).radiance(-axis)[0], 1.0f);
  EXPECT_EQ(Environment::disc(axis, 0, Rgb::Ones()).project(2).channel(0)[0], 0.0f);
}

TEST(LookUp, PixelsThatAreNoNumbersAreBlack) {
  image::Image image(8, 4);
  for (Rgb& p : image.pixels) p = Rgb::Ones();
  image.at(3, 2) = Rgb(1, NAN, 0);
  image.at(4, 1) = Rgb(INFINITY, 0, 0);
  const Environment light = Environment::latLong(image);
  math::Random random(1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Environment::Sample s = light.sample(random.uniform(), random.uniform());
    EXPECT_TRUE(s.radianceOverPdf.isFinite().all() && std::isfinite(s.pdf));
  }
  for (const float f : light.project(3).values) EXPECT_TRUE(std::isfinite(f));
}

TEST(Rotation, MovesLookUpSamplesAndProjectionTogether) {
  const Mat3 turn = math::randomRotation(33);
  for (const Case& c : allKinds()) {
    if (c.name.ends_with("sun")) continue;  // random directions miss it
    const Environment turned = c.light.rotated(turn);
    math::Random random(2, 2);
    int different = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 s = math::uniformSphere(random.uniform2());
      const Rgb before = c.light.radiance(s), after = turned.radiance(turn * s);
      different += !after.isApprox(before, 1e-3f) && (after - before).abs().maxCoeff() > 1e-3f;
    }
    EXPECT_LE(different, 1) << c.name;  // a direction may fall across a disc's rim
    const auto f = c.light.project(5);
    float largest = 1;
    for (const float x : f.values) largest = std::max(largest, std::abs(x));
    expectNear(turned.project(5), sh::rotate(turn, f), 5e-6 * double(largest), c.name);
  }
}

TEST(Sampling, IsUnbiased) {
  constexpr int kBands = 4, kCount = 16, kDraws = 40000;
  for (const Case& c : allKinds()) {
    const auto expected = c.light.project(kBands);
    math::Random random(11, 3);
    std::vector<math::RunningMoments> moments(3 * kCount);
    std::vector<float> y(kCount);
    for (int n = 0; n < kDraws; ++n) {
      const Environment::Sample s = c.light.sample(random.uniform(), random.uniform());
      ASSERT_NEAR(s.direction.norm(), 1, 1e-5) << c.name;
      sh::evaluate(kBands, s.direction, std::span<float>(y));
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < kCount; ++i)
          moments[k * kCount + i].add(double(s.radianceOverPdf[k]) * double(y[i]));
    }
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < kCount; ++i) {
        const auto& m = moments[k * kCount + i];
        const double mean = expected.channel(k)[i];
        // Where every draw gives the same number there is no error but that of rounding.
        const double error = m.standardError() + 2e-6 * (1 + std::abs(mean));
        EXPECT_LT(std::abs(m.mean() - mean) / error, kLargestZ) << c.name << " " << k << " " << i;
      }
  }
}

TEST(Sampling, DensityIsThatOfWhatIsDrawn) {
  for (const Case& c : allKinds()) {
    math::Random random(12, 4);
    int apart = 0, delta = 0;
    constexpr int kDraws = 4000;
    for (int n = 0; n < kDraws; ++n) {
      const Environment::Sample s = c.light.sample(random.uniform(), random.uniform());
      if (std::isinf(s.pdf)) {
        ++delta;
        continue;
      }
      const float pdf = c.light.pdf(s.direction);
      const Rgb radiance = c.light.radiance(s.direction);
      const bool close = std::abs(pdf - s.pdf) <= 5e-3f * s.pdf &&
                         (radiance - s.radianceOverPdf * s.pdf).abs().maxCoeff() <=
                             5e-3f * (1e-3f + radiance.abs().maxCoeff());
      apart += !close;
    }
    // Rounding carries a draw over the rim of a disc or the edge of a cell now and then.
    EXPECT_LE(apart, kDraws / 200) << c.name;
    const double spread = std::sqrt(kDraws * c.directional * (1 - c.directional));
    EXPECT_LE(std::abs(delta - kDraws * c.directional), kLargestZ * spread) << c.name;
  }
}

TEST(Sampling, DensityIntegratesToOne) {
  for (const Case& c : allKinds()) {
    if (c.name.ends_with("sun")) continue;
    // Strata on the sphere; the variance of independent draws bounds theirs from above.
    constexpr int kColumns = 600, kRows = 300;
    math::Random random(13, 5);
    math::RunningMoments moments;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const Vec2 u((float(y) + random.uniform()) / kRows,
                     (float(x) + random.uniform()) / kColumns);
        moments.add(4 * kPi * double(c.light.pdf(math::uniformSphere(u))));
      }
    const double error = moments.standardError() + 1e-6;
    EXPECT_LT(std::abs(moments.mean() - (1 - c.directional)) / error, kLargestZ) << c.name;
    EXPECT_LT(error, 0.02) << c.name;
  }
}

TEST(Sampling, ReachesWhateverHasRadiance) {
  for (const Case& c : allKinds()) {
    math::Random random(14, 6);
    for (int n = 0; n < 20000; ++n) {
      const Vec3 s = math::uniformSphere(random.uniform2());
      if ((c.light.radiance(s).abs() > 0).any()) {
        ASSERT_GT(c.light.pdf(s), 0) << c.name;
      }
    }
  }
}

TEST(Sampling, OfAnImageFollowsItsLuminance) {
  // A small sun that outshines everything: the weights stay bounded, so the variance does.
  image::Image image(64, 32);
  for (Rgb& p : image.pixels) p = Rgb::Constant(0.1f);
  image.at(20, 6) = Rgb::Constant(30000);
  const Environment light = Environment::latLong(image);
  math::Random random(15, 7);
  math::RunningMoments moments;
  for (int n = 0; n < 20000; ++n)
    moments.add(double(light.sample(random.uniform(), random.uniform()).radianceOverPdf[1]));
  EXPECT_LT(std::sqrt(moments.variance()) / moments.mean(), 0.1);
}

TEST(Sampling, KeepsTheSignOfRingingLight) {
  const Environment light = Environment::harmonics(randomHarmonics(5, 3));
  math::Random random(16, 8);
  int negative = 0;
  for (int n = 0; n < 1000; ++n)
    negative += light.sample(random.uniform(), random.uniform()).radianceOverPdf[0] < 0;
  EXPECT_GT(negative, 100);
}

TEST(Sampling, OfBlackIsHarmless) {
  image::Image dark(4, 2);
  for (const Environment& light :
       {Environment(), Environment::latLong(dark), Environment::latLong(image::Image()),
        Environment::harmonics(sh::RgbCoefficients(3)), Environment::harmonics({}),
        Environment::disc(Vec3::UnitX(), 0, Rgb::Ones()), Environment() + Environment()}) {
    const Environment::Sample s = light.sample(0.3f, 0.999999f);
    EXPECT_EQ(s.radianceOverPdf.abs().maxCoeff(), 0);
    EXPECT_TRUE(std::isfinite(s.pdf));
    EXPECT_NEAR(light.pdf(Vec3::UnitY()), 1 / (4 * kPi), 1e-6);
  }
}

TEST(Environment, IsTheSumOfItsParts) {
  const Mat3 turn = Eigen::AngleAxisf(1.1f, Vec3(1, -2, 0.5f).normalized()).toRotationMatrix();
  const Environment image = Environment::latLong(randomImage(16, 8, 3));
  const Environment whole = Environment::uniform(Rgb(0.1f, 0.2f, 0.3f)) + image.rotated(turn) +
                            Environment::disc(Vec3::UnitX(), 1.2, Rgb(3, 2, 1)).rotated(turn) +
                            Environment::directional(Vec3::UnitY(), Rgb::Ones()) +
                            Environment::harmonics(randomHarmonics(3, 5)) +
                            Environment::clampedCosine(Vec3::UnitZ(), Rgb(1, 0, 2));
  const Environment::Parts parts = whole.parts();
  ASSERT_EQ(parts.discs.size(), 1u);
  ASSERT_EQ(parts.images.size(), 1u);
  EXPECT_EQ(parts.others.size(), 2u);
  EXPECT_EQ(parts.images[0].image, image.parts().images[0].image);
  for (int k = 0; k < 200; ++k) {
    const float z = (k + 0.5f) / 100 - 1, r = std::sqrt(1 - z * z), phi = 2.399963f * k;
    const Vec3 d(r * std::cos(phi), r * std::sin(phi), z);
    Rgb sum = parts.uniform;
    for (const auto& disc : parts.discs)
      if ((d - disc.axis).squaredNorm() <= 2 * disc.versine) sum += disc.radiance;
    for (const auto& part : parts.images)
      sum += Environment::latLong(*part.image).rotated(part.worldFromImage).radiance(d);
    for (const Environment& other : parts.others) sum += other.radiance(d);
    EXPECT_LT((sum - whole.radiance(d)).abs().maxCoeff(), 1e-4f) << d.transpose();
  }
}

TEST(GridDistribution, DrawsCellsWithTheirProbabilities) {
  const std::vector<double> weights = {0, 1, 2, 0, 0, 0, 3, 0, 2};
  const GridDistribution grid(3, 3, weights);
  std::vector<int> counts(9);
  constexpr int kSteps = 800;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const auto cell = grid.draw((i + 0.5) / kSteps, (j + 0.5) / kSteps);
      ASSERT_TRUE(cell.u >= 0 && cell.u < 1 && cell.v >= 0 && cell.v < 1);
      ++counts[cell.y * 3 + cell.x];
    }
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(counts[k] / double(kSteps * kSteps), weights[k] / 8, 1e-3);
    EXPECT_NEAR(grid.probability(k % 3, k / 3), weights[k] / 8, 1e-15);
  }
  const auto last = grid.draw(1 - 0x1p-53, 1 - 0x1p-53);
  EXPECT_EQ(last.y * 3 + last.x, 8);
}

}  // namespace
}  // namespace lambent::light
