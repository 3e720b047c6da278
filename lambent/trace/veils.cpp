#include "lambent/trace/veils.h"

#include <algorithm>
#include <cmath>

namespace lambent::trace {

namespace {

constexpr int kMostVeils = 1024;  ///< in a row; then it is dark
constexpr float kLeast = 1e-5f;   ///< share of light that is worth another ray

}  // namespace

std::vector<scene::Passing> passingsOnTheWay(const scene::Scene& scene) {
  std::vector<scene::Passing> passings = scene::passingsOf(scene);
  for (std::size_t m = 0; m < passings.size(); ++m)
    if (scene.meshes[m].layer) passings[m] = scene::Passing::Nothing;
  return passings;
}

Veils::Veils(const scene::Scene& scene) : scene_(scene), passings_(passingsOnTheWay(scene)) {
  any_ = std::find(passings_.begin(), passings_.end(), scene::Passing::Shares) != passings_.end();
}

// Some units in the last place: the same triangle, met again, is at the same distance.
float Veils::beyond(const Hit& hit) {
  return std::nextafter(hit.distance * (1.0f + 5e-7f), std::numeric_limits<float>::infinity());
}

Rgb Veils::throughput(const RayScene& rays, const Vec3& origin, const Vec3& direction,
                      float tFar) const {
  if (!any_) return rays.occluded(origin, direction, 0.0f, tFar) ? Rgb::Zero() : Rgb::Ones();
  Rgb throughput = Rgb::Ones();
  float tNear = 0.0f;
  for (int veils = 0; veils < kMostVeils; ++veils) {
    const std::optional<Hit> hit = rays.closest(origin, direction, tNear, tFar);
    if (!hit) return throughput;
    if (!has(hit->mesh)) break;
    throughput *= passed(*hit);
    if (!(throughput.maxCoeff() > kLeast)) break;
    tNear = beyond(*hit);
  }
  return Rgb::Zero();
}

}  // namespace lambent::trace
