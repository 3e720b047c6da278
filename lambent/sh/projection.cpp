// A product rule on the sphere (atkinson1982numerical): Gauss-Legendre in z, the trapezoidal rule
// in azimuth, which is the Gauss rule of the circle.
#include "lambent/sh/projection.h"

#include <cassert>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"

namespace lambent::sh {

std::vector<double> project(int bands, const std::function<double(const Vec3d&)>& f,
                            int resolution) {
  assert(bands >= 1 && resolution >= bands);
  const math::Quadrature rule = math::gaussLegendre(resolution);
  const int turns = 2 * resolution;
  std::vector<double> result(std::size_t(coefficientCount(bands)));
  std::vector<double> y(result.size());
  for (int i = 0; i < resolution; ++i) {
    const double z = rule.nodes[i], sine = std::sqrt((1 - z) * (1 + z));
    const double weight = rule.weights[i] * 2 * kPi / turns;
    for (int k = 0; k < turns; ++k) {
      const double azimuth = 2 * kPi * (k + 0.5) / turns;
      const Vec3d s(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
      const double value = weight * f(s);
      if (value == 0) continue;
      evaluate(bands, s, y);
      for (std::size_t j = 0; j < y.size(); ++j) result[j] += value * y[j];
    }
  }
  return result;
}

}  // namespace lambent::sh
