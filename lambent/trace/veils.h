// Surfaces that let a share of the light go on straight through them. (Holes need no such care: rays
// pass over them by themselves.)
#pragma once

#include <limits>
#include <vector>

#include "lambent/scene/coverage.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::trace {

/// What rays on their way have to know of every mesh: they do not meet layers.
std::vector<scene::Passing> passingsOnTheWay(const scene::Scene& scene);

class Veils {
 public:
  /// Keeps a reference: the scene must outlive it.
  explicit Veils(const scene::Scene& scene);

  bool any() const { return any_; }
  bool has(std::uint32_t mesh) const { return passings_[mesh] == scene::Passing::Shares; }
  /// What of the light goes on behind a hit of a mesh that has them.
  Rgb passed(const Hit& hit) const {
    return scene::passedAt(scene_, hit.mesh, hit.triangle, hit.u, hit.v);
  }
  /// What of the surface is there.
  float coverage(const Hit& hit) const {
    return scene::coverageAt(scene_, hit.mesh, hit.triangle, hit.u, hit.v);
  }
  /// From where a ray goes on behind a hit.
  static float beyond(const Hit& hit);

  /// What comes through along a way, [0, 1]; 0 where anything else than a veil is met.
  Rgb throughput(const RayScene& rays, const Vec3& origin, const Vec3& direction,
                 float tFar = std::numeric_limits<float>::infinity()) const;

 private:
  const scene::Scene& scene_;
  std::vector<scene::Passing> passings_;
  bool any_ = false;
};

}  // namespace lambent::trace
