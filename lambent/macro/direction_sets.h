// Which directions a receiver looks into.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/direction_set.h"

namespace lambent::macro {

/// One lattice of directions, turned several ways. If all receivers looked into the same
/// directions, the borders of what they see would cross those directions in step, and flat walls
/// show a plaid of them; neighbours that look into different ones show a fine grain of the same
/// size, which the eye passes over. A receiver's set follows from where it stands in the scene
/// alone, in cells of a power of two, a 4096th of the scene or less: the same surface has the same
/// ones in whatever sequence its vertices are and wherever the scene stands, and so do both sides
/// of a seam.
class DirectionSets {
 public:
  /// `directions` of each set, ≥ 1; `box` of the scene. As many sets as keep tables of them small.
  DirectionSets(int directions, std::uint64_t seed, const scene::Box& box);

  std::size_t count() const { return sets_.size(); }
  const trace::DirectionSet& operator[](std::size_t number) const { return sets_[number]; }
  /// Of the set of a receiver that stands there.
  std::size_t numberAt(const Vec3& position) const;

 private:
  std::vector<trace::DirectionSet> sets_;
  std::uint64_t seed_;
  Vec3 middle_ = Vec3::Zero();
  float cell_ = 1.0f;
};

}  // namespace lambent::macro
