// Private to this room: what a RayScene holds.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "lambent/trace/holes.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::trace {

/// Embree's geometries: surfaces with holes ask at every hit whether anything is there.
enum Geometry : unsigned { kWhole = 0, kHoled = 1 };

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t> triangleOffsets, vertexOffsets;
  float offset = 0.0f;
  std::unique_ptr<Holes> holes;  ///< null: there are none

  /// What a triangle of Embree's is, in global numbers, seen from either side. Of a mesh with backs
  /// (scene/sheets.h) only the fronts are Embree's: two triangles in one place would hide each other.
  struct Sides {
    std::uint32_t front;
    std::uint32_t back;  ///< the same as `front`: there is none
  };
  /// By geometry. Both empty: Embree's numbers are global, and nothing has backs.
  std::array<std::vector<Sides>, 2> sides;
  bool numbered = false;  ///< whether `sides` are to be asked

  /// What Embree met, `triangle` by its number of it, as a global triangle on the side that was met.
  void nameSide(unsigned geometry, std::uint32_t& triangle, float& u, float& v,
                bool& backFace) const {
    if (!numbered) return;
    const Sides& met = sides[geometry][triangle];
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
