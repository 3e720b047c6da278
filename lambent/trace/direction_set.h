// A fixed set of directions over the sphere, ordered so that neighbours travel together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::trace {

/// Equally weighted unit directions (4π/size() sr each), a spherical Fibonacci lattice turned by a
/// rotation and sorted along a Morton curve on the octahedron. Sixteen neighbours form a bundle
/// that points nearly one way: the packets of the casts, and the unit of culling by the hemisphere
/// (the bins of sloan2002precomputed §5, flat instead of a hierarchy: 512 cone tests a receiver
/// cost less than one ray in a thousand).
class DirectionSet {
 public:
  static constexpr int kBundle = 16;

  /// count ≥ 1; it need not be a multiple of 16.
  DirectionSet(int count, const Mat3& rotation);
  /// Unit directions that the caller chose, sorted in the same way: what belongs to a direction is
  /// found by its value, and weight() means nothing unless they are evenly spread. Not empty.
  explicit DirectionSet(std::vector<Vec3> directions);

  std::size_t size() const { return directions_.size(); }
  double weight() const { return 4.0 * kPi / static_cast<double>(size()); }  ///< steradians each
  const Vec3& operator[](std::size_t i) const { return directions_[i]; }

  struct Bundle {
    Vec3 axis;
    float sinAngle;  ///< of the cone about axis that holds the bundle; 1 if it is wider than 90°
  };
  std::span<const Bundle> bundles() const { return bundles_; }
  /// Coordinates, padded to whole bundles by repeating the last direction.
  std::span<const float> x() const { return x_; }
  std::span<const float> y() const { return y_; }
  std::span<const float> z() const { return z_; }

 private:
  std::vector<Vec3> directions_;
  std::vector<Bundle> bundles_;
  std::vector<float> x_, y_, z_;
};

}  // namespace lambent::trace
