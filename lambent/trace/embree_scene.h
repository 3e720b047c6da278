// Private to this room: what a RayScene holds.
#pragma once

#include <embree3/rtcore.h>

#include <utility>
#include <vector>

#include "lambent/trace/ray_scene.h"

namespace lambent::trace {

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t> triangleOffsets, vertexOffsets;
  float offset = 0.0f;

  /// What a triangle of Embree's is, in global numbers, seen from either side. Of a mesh with backs
  /// (scene/sheets.h) only the fronts are Embree's: two triangles in one place would hide each other.
  struct Sides {
    std::uint32_t front;
    std::uint32_t back;  ///< the same as `front`: there is none
  };
  std::vector<Sides> sides;  ///< empty: Embree's numbers are global, and nothing has backs

  /// What Embree met, `triangle` by its number of it, as a global triangle on the side that was met.
  void nameSide(std::uint32_t& triangle, float& u, float& v, bool& backFace) const {
    if (sides.empty()) return;
    const Sides& met = sides[triangle];
    triangle = met.front;
    if (!backFace || met.back == met.front) return;
    triangle = met.back;
    std::swap(u, v);
    backFace = false;
  }

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

}  // namespace lambent::trace
