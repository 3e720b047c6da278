// A component that another room makes, as an Environment. environment_test.cpp holds it to the same
// as every other kind: that sampling is unbiased, the density integrates to 1, and a rotation moves
// look-up, samples and projection together.
#include "lambent/light/component.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "lambent/light/test_component.h"
#include "lambent/math/directions.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/sh/basis.h"

namespace lambent::light {
namespace {

const Vec3 kAxis = Vec3(1, 2, -0.5f).normalized();
const Rgb kColor(1, 2, 4);

Environment gradient() {
  return Environment::of(std::make_shared<test::Gradient>(kAxis, 0.75, kColor));
}

TEST(Component, IsLookedUp) {
  const Environment light = gradient();
  EXPECT_TRUE(light.radiance(kAxis).isApprox(kColor * 1.75f, 1e-5f));
  EXPECT_TRUE(light.radiance(-kAxis).isApprox(kColor * 0.25f, 1e-5f));
  EXPECT_NEAR(light.pdf(kAxis), 1.75 / (4 * kPi), 1e-6);
}

TEST(Component, IsProjected) {
  // Gauss-Legendre in z and even steps in azimuth integrate these bands exactly.
  const Environment light = gradient();
  constexpr int kBands = 4, kCount = kBands * kBands, kSteps = 16;
  const math::Quadrature rule = math::gaussLegendre(8, -1.0, 1.0);
  std::vector<double> sum(3 * kCount), y(kCount);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    for (int j = 0; j < kSteps; ++j) {
      const double z = rule.nodes[k], r = std::sqrt(1 - z * z), turn = 2 * kPi * j / kSteps;
      const Vec3d s(r * std::cos(turn), r * std::sin(turn), z);
      sh::evaluate(kBands, s, std::span<double>(y));
      const Rgb radiance = light.radiance(s.cast<float>());
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < kCount; ++i)
          sum[c * kCount + i] += rule.weights[k] * 2 * kPi / kSteps * radiance[c] * y[i];
    }
  const sh::RgbCoefficients f = light.project(kBands);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < kCount; ++i) EXPECT_NEAR(f.channel(c)[i], sum[c * kCount + i], 1e-5);
}

TEST(Component, IsOneTermOfASum) {
  const Mat3 turn = math::randomRotation(7);
  const Environment disc = Environment::disc(Vec3::UnitX(), 1.0, Rgb(3, 2, 1));
  const Environment light = gradient().rotated(turn) + disc;
  math::Random random(5, 1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 s = math::uniformSphere(random.uniform2());
    const Rgb expected = gradient().radiance(turn.transpose() * s) + disc.radiance(s);
    EXPECT_LT((light.radiance(s) - expected).abs().maxCoeff(), 1e-5f);
  }
  const auto sum = light.project(3), a = gradient().rotated(turn).project(3), b = disc.project(3);
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    EXPECT_NEAR(sum.values[i], a.values[i] + b.values[i], 1e-5);
}

TEST(Component, IsAmongTheOtherPartsUnlessItSaysWhereItBelongs) {
  const Environment::Parts parts = (gradient() + Environment::uniform(Rgb::Ones())).parts();
  ASSERT_EQ(parts.others.size(), 1u);
  EXPECT_TRUE((parts.others[0].radiance(kAxis) == gradient().radiance(kAxis)).all());
  EXPECT_TRUE((parts.uniform == Rgb::Ones()).all());
}

}  // namespace
}  // namespace lambent::light
