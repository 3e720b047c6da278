// Private to this room: where on the surfaces of a scene to look for shadows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::macro {

/// A point inside a triangle, with corners weighing (1−u−v, u, v).
struct SurfaceSample {
  std::uint32_t mesh, triangle;
  float u, v;
};

struct SurfaceSamples {
  std::vector<SurfaceSample> samples;
  /// How far surfaces are from what stands before them: the median length of the rays that found
  /// samples, metres; 0 if none did.
  float feature = 0.0f;
};

/// Points on the meshes that are looked at ([mesh]). Half of `count` are spread evenly by area. The
/// rest are where something stands before the surface, however small it is beside it: from random
/// places of all meshes, half by area and half by number of triangles, a ray is sent forth, spread
/// as a white surface spreads light, and the front that it meets is a sample (fewer than half,
/// where rays leave the scene). Depends on its arguments alone.
SurfaceSamples drawSamples(const scene::Scene& scene, const trace::RayScene& rays,
                           const std::vector<bool>& isLookedAt, std::size_t count,
                           std::uint64_t seed);

}  // namespace lambent::macro
