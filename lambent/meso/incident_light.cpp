// This work is based on:
// - sloan2003biscale: §4.2, eq. (5), for the directional lights.
// - sloan2002precomputed: §5, for direct transfer by shadow rays towards a set of directions.
#include "lambent/meso/incident_light.h"

#include <algorithm>

#include "lambent/math/random.h"
#include "lambent/sh/basis.h"

namespace lambent::meso {

namespace {

std::vector<Vec3> directionsOf(const std::vector<DirectionalLight>& lights) {
  std::vector<Vec3> directions;
  for (const DirectionalLight& light : lights) directions.push_back(light.direction);
  return directions;
}

}  // namespace

Lattice::Lattice(int count, std::uint64_t seed, int bands)
    : directions(count, math::randomRotation(seed)), table(directions, bands) {}

LightRows::LightRows(int polar, int azimuth, int bands)
    : directions(directionsOf(lightGrid(polar, azimuth))) {
  const std::vector<DirectionalLight> lights = lightGrid(polar, azimuth);
  const std::vector<double> weights = harmonicWeights(lights, bands);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(bands));
  stride = transport::paddedRow(count);
  values.assign(lights.size() * stride, 0.0f);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const auto light = std::find_if(lights.begin(), lights.end(), [&](const DirectionalLight& l) {
      return l.direction == directions[d];
    });
    const std::size_t k = static_cast<std::size_t>(light - lights.begin());
    for (std::size_t i = 0; i < count; ++i)
      values[d * stride + i] = static_cast<float>(weights[k * count + i]);
  }
}

Irradiance::Irradiance(int bands)
    : cosine_(sh::clampedCosine(bands)),
      lobe_(static_cast<std::size_t>(sh::coefficientCount(bands))) {}

void Irradiance::fromLattice(const Lattice& lattice, const Vec3& normal, const PeriodicCast& cast,
                             double* out) {
  const bool byBlocked = cast.blocked.size() < cast.visible.size();
  const std::vector<std::uint32_t>& fewer = byBlocked ? cast.blocked : cast.visible;
  const auto weight = static_cast<float>(lattice.directions.weight()) * (byBlocked ? -1.0f : 1.0f);
  weights_.resize(fewer.size());
  for (std::size_t k = 0; k < fewer.size(); ++k)
    weights_[k] = weight * normal.dot(lattice.directions[fewer[k]]);
  std::fill_n(out, lattice.table.rows().stride, 0.0);
  transport::addRows(lattice.table.rows(), fewer, weights_, out);
  if (!byBlocked) return;
  sh::turnTo(cosine_, Vec3d(normal.cast<double>().normalized()), std::span<double>(lobe_));
  for (std::size_t i = 0; i < lobe_.size(); ++i) out[i] += lobe_[i];
}

void Irradiance::fromLights(const LightRows& lights, const Vec3& normal, const PeriodicCast& cast,
                            double* out) {
  weights_.resize(cast.visible.size());
  for (std::size_t k = 0; k < cast.visible.size(); ++k)
    weights_[k] = normal.dot(lights.directions[cast.visible[k]]);
  std::fill_n(out, lights.stride, 0.0);
  transport::addRows(lights.rows(), cast.visible, weights_, out);
}

}  // namespace lambent::meso
