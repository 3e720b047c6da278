#include "lambent/macro/direction_sets.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/random.h"

namespace lambent::macro {

namespace {

/// Directions in all sets together: at five bands their harmonics take 8 MiB.
constexpr int kAllDirections = 65536;
constexpr int kMostSets = 8;
constexpr float kCellsAcross = 4096.0f;  ///< at least
/// Where cells begin, in cells: what models are built on, corners and middles, is no border of one.
constexpr float kOffset = 0.37f;

}  // namespace

DirectionSets::DirectionSets(int directions, std::uint64_t seed, const scene::Box& box)
    : seed_(seed) {
  const int count = std::clamp(kAllDirections / std::max(directions, 1), 1, kMostSets);
  for (int k = 0; k < count; ++k)
    sets_.emplace_back(directions, math::randomRotation(
                                       k == 0 ? seed : math::hashCombine(seed, std::uint64_t(k))));
  if (box.empty()) return;
  middle_ = box.center();
  cell_ = std::exp2(std::floor(std::log2(std::max(box.diagonal() / kCellsAcross, 1e-30f))));
}

std::size_t DirectionSets::numberAt(const Vec3& position) const {
  std::uint64_t key = seed_;
  for (int axis = 0; axis < 3; ++axis) {
    const float cell = std::floor((position[axis] - middle_[axis]) / cell_ + kOffset);
    key = math::hashCombine(key, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)));
  }
  return static_cast<std::size_t>((key >> 32) % sets_.size());
}

}  // namespace lambent::macro
