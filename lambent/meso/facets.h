// Private to this room: the places of a patch where bounced light is kept.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/meso/periodic_scene.h"

namespace lambent::meso {

/// The tile's triangles, each cut into n² congruent parts of at most a given size. Nothing is cut
/// for the ray tracer: a hit's barycentric coordinates say which part it met.
class Facets {
 public:
  /// `spacing`: of a facet's longest edge at most, metres.
  Facets(const PeriodicScene& scene, float spacing);

  std::size_t size() const { return points_.size(); }
  /// The facet that a hit lies in.
  std::uint32_t at(const PeriodicHit& hit) const;
  /// Its middle, with the material's reflectances.
  const scene::SurfacePoint& point(std::uint32_t facet) const { return points_[facet]; }
  /// What a facet sends on of the irradiance that it gets: diffuse and glossy reflectance together.
  Rgb albedo(std::uint32_t facet) const;
  /// Whether R, G and B are the same everywhere.
  bool grey() const { return grey_; }

 private:
  std::vector<std::uint32_t> first_;  ///< of each triangle
  std::vector<std::uint16_t> cuts_;   ///< n of each triangle
  std::vector<scene::SurfacePoint> points_;
  bool grey_ = true;
};

}  // namespace lambent::meso
