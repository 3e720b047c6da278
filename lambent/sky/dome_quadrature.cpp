#include "lambent/sky/dome_quadrature.h"

#include <cmath>

#include "lambent/math/quadrature.h"

namespace lambent::sky {

DomeQuadrature domeQuadrature(int elevations, int azimuths) {
  const math::Quadrature sines = math::gaussLegendre(elevations, 0, 1);
  const math::Quadrature angles = math::gaussLegendre(azimuths, 0, kPi);
  DomeQuadrature dome;
  for (size_t i = 0; i < sines.nodes.size(); ++i) {
    const double y = sines.nodes[i], across = std::sqrt(1 - y * y);
    for (size_t j = 0; j < angles.nodes.size(); ++j) {
      dome.directions.emplace_back(across * std::cos(angles.nodes[j]), y,
                                   across * std::sin(angles.nodes[j]));
      dome.solidAngles.push_back(2 * sines.weights[i] * angles.weights[j]);
    }
  }
  return dome;
}

double onHorizontalPlane(const std::function<double(const Vec3d&)>& luminance,
                         const DomeQuadrature& quadrature) {
  double sum = 0;
  for (size_t i = 0; i < quadrature.directions.size(); ++i) {
    const Vec3d& direction = quadrature.directions[i];
    sum += quadrature.solidAngles[i] * direction.y() * luminance(direction);
  }
  return sum;
}

double onHorizontalPlane(const std::function<double(const Vec3d&)>& luminance) {
  static const DomeQuadrature quadrature = domeQuadrature();
  return onHorizontalPlane(luminance, quadrature);
}

}  // namespace lambent::sky
