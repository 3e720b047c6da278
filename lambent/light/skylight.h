// Light from above a horizon, smooth there and nothing below: a sky without its Sun.
#pragma once

#include <span>

#include "lambent/math/types.h"

namespace lambent::light {

/// Immutable, and looked up from many threads at once. Directions are unit vectors in a frame of its
/// own with +y up; radiance in W m⁻² sr⁻¹ per channel.
class Skylight {
 public:
  virtual ~Skylight() = default;
  /// Elevation of the horizon, rad, above −π/2 and below π/2.
  virtual double horizon() const = 0;
  /// Finite and never negative; asked for at the horizon and above it.
  virtual Rgb radiance(const Vec3d& direction) const = 0;
  /// Adds ∫ radiance y_i ds over what is above the horizon, as Component::addProjection.
  virtual void addProjection(int bands, std::span<double> out) const = 0;
};

}  // namespace lambent::light
