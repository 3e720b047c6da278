// This work is based on:
// - sloan2003biscale: §4.2, eq. (5): B_i = Σ_k I_k y_i(l_k) da(l_k).
//
// Where we deviate, and why. The paper does not say where in its cell a light stands. At the middle
// polar angle, a level surface under uniform light would get π/cos(π/(4·polar)), half a percent too
// much with 8 rings; at the middle height z the sum Σ cos θ_k da_k telescopes to exactly π.
#include "lambent/meso/light_grid.h"

#include <cassert>
#include <cmath>

#include "lambent/sh/basis.h"

namespace lambent::meso {

std::vector<DirectionalLight> lightGrid(int polar, int azimuth) {
  assert(polar >= 1 && azimuth >= 1);
  std::vector<DirectionalLight> lights;
  lights.reserve(static_cast<std::size_t>(polar) * azimuth);
  for (int ring = 0; ring < polar; ++ring) {
    const double upper = std::cos(0.5 * kPi * ring / polar);
    const double lower = ring + 1 == polar ? 0.0 : std::cos(0.5 * kPi * (ring + 1) / polar);
    const double z = 0.5 * (upper + lower), radius = std::sqrt(1.0 - z * z);
    for (int k = 0; k < azimuth; ++k) {
      const double turn = 2.0 * kPi * (k + 0.5) / azimuth;
      lights.push_back({Vec3d(radius * std::cos(turn), radius * std::sin(turn), z).cast<float>(),
                        2.0 * kPi * (upper - lower) / azimuth});
    }
  }
  return lights;
}

std::vector<double> harmonicWeights(const std::vector<DirectionalLight>& lights, int bands) {
  const auto count = static_cast<std::size_t>(sh::coefficientCount(bands));
  std::vector<double> weights(lights.size() * count);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const std::span<double> row(weights.data() + k * count, count);
    sh::evaluate(bands, Vec3d(lights[k].direction.cast<double>().normalized()), row);
    for (double& y : row) y *= lights[k].solidAngle;
  }
  return weights;
}

}  // namespace lambent::meso
