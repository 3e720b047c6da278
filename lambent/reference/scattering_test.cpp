// Drawing and density of the two lobes, alone and mixed.
#include "lambent/reference/scattering.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/statistics.h"
#include "lambent/reference/test_statistics.h"

namespace lambent::reference {
namespace {

scene::SurfacePoint surface(const Rgb& diffuse, const Rgb& glossy, float exponent) {
  scene::SurfacePoint point;
  point.position = Vec3::Zero();
  point.normal = point.geometricNormal = Vec3(0.3f, 0.8f, -0.5f).normalized();
  point.diffuse = diffuse;
  point.glossy = glossy;
  point.mirror = Rgb::Zero();
  point.lobeExponent = exponent;
  return point;
}

struct Case {
  scene::SurfacePoint point;
  float viewCosine;
};

std::vector<Case> cases() {
  return {{surface(Rgb(0.8f, 0.5f, 0.1f), Rgb::Zero(), 16), 0.7f},
          {surface(Rgb::Zero(), Rgb(0.3f, 0.6f, 0.9f), 16), 0.7f},
          {surface(Rgb::Zero(), Rgb::Ones(), 0), 1.0f},
          {surface(Rgb(0.4f, 0.3f, 0.2f), Rgb(0.2f, 0.3f, 0.4f), 64), 0.2f},
          {surface(Rgb(0.4f, 0.3f, 0.2f), Rgb(0.2f, 0.3f, 0.4f), 4), -0.3f}};
}

Vec3 viewAt(const scene::SurfacePoint& point, float cosine) {
  return math::worldFromTangent(point.normal) * Vec3(std::sqrt(1 - cosine * cosine), 0, cosine);
}

TEST(Scattering, DrawsWithItsDensity) {
  for (const Case& c : cases()) {
    const Scattering scattering(c.point, viewAt(c.point, c.viewCosine));
    math::Random random(1, 0);
    // The density integrates to one; draws and uniform directions give the same integrals.
    math::RunningMoments whole, drawn[4], uniform[4];
    for (int n = 0; n < 100000; ++n) {
      const auto test = [&](const Vec3& s, int k) {
        return k == 3 ? 1.0 + double(s.y() * s.z()) : double(s[k] + s[k] * s[k]);
      };
      const Vec3 s = math::uniformSphere(random.uniform2());
      const double pdf = scattering.pdf(s);
      whole.add(pdf * 4 * kPi);
      for (int k = 0; k < 4; ++k) uniform[k].add(pdf * 4 * kPi * test(s, k));
      const Vec3 d = scattering.draw(random.uniform2(), random.uniform());
      ASSERT_NEAR(d.norm(), 1, 1e-5);
      for (int k = 0; k < 4; ++k) drawn[k].add(test(d, k));
    }
    EXPECT_LT(std::abs(whole.mean() - 1) / whole.standardError(), kLargestZ);
    for (int k = 0; k < 4; ++k) {
      const double error = std::hypot(drawn[k].standardError(), uniform[k].standardError());
      EXPECT_LT(std::abs(drawn[k].mean() - uniform[k].mean()) / error, kLargestZ) << k;
    }
  }
}

TEST(Scattering, EstimatesItsIntegral) {
  for (const Case& c : cases()) {
    const Scattering scattering(c.point, viewAt(c.point, c.viewCosine));
    math::Random random(2, 0);
    math::RunningMoments drawn, uniform;
    for (int n = 0; n < 100000; ++n) {
      const Vec3 s = math::uniformSphere(random.uniform2());
      uniform.add(double(scattering.value(s)[1]) * 4 * kPi);
      const Vec3 d = scattering.draw(random.uniform2(), random.uniform());
      drawn.add(double(scattering.value(d)[1]) / double(scattering.pdf(d)));
    }
    const double error = std::hypot(drawn.standardError(), uniform.standardError()) + 1e-6;
    EXPECT_LT(std::abs(drawn.mean() - uniform.mean()) / error, kLargestZ);
  }
}

TEST(Scattering, NothingComesFromBehind) {
  const Case c = cases()[4];
  const Scattering scattering(c.point, viewAt(c.point, c.viewCosine));
  math::Random random(3, 0);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 s = math::uniformSphere(random.uniform2());
    if (s.dot(c.point.normal) <= 0) {
      EXPECT_EQ(scattering.value(s).maxCoeff(), 0);
    }
  }
}

}  // namespace
}  // namespace lambent::reference
