// Private to this room: what of a scene tells rays where its holes are.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <vector>

#include "lambent/scene/coverage.h"

namespace lambent::trace {

/// A copy of what says how much of a surface is there, of the meshes that let light through.
class Holes {
 public:
  Holes(const scene::Scene& scene, const std::vector<scene::Passing>& passings);

  /// The traced triangles by number.
  struct Place {
    std::uint32_t mesh, triangle;
  };
  std::vector<Place> places;

  /// Whether nothing of the surface is there.
  bool at(std::uint32_t traced, float u, float v) const {
    const Place& place = places[traced];
    return !(scene::coverageAt(scene_, place.mesh, place.triangle, u, v) > 0.0f);
  }

  /// Makes Embree pass over holes of a geometry, whose user data are the Holes.
  static void passOver(RTCGeometry geometry, const Holes& holes);

 private:
  scene::Scene scene_;
};

}  // namespace lambent::trace
