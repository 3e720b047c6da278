#include "lambent/macro/sight.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/random.h"
#include "lambent/sh/basis.h"

namespace lambent::macro {

namespace {

constexpr std::size_t kSet = Sight::kDirections;

bool isOpen(const Sight& sight, std::size_t bit) {
  return (sight.open[bit / 64] >> (bit % 64) & 1u) != 0;
}

float cosineWhere(bool open, const Sight& sight, std::size_t bit, const Vec3& direction) {
  return isOpen(sight, bit) == open ? std::max(0.0f, sight.normal.dot(direction)) : 0.0f;
}

}  // namespace

Corners exposed(const Corners& corners) {
  float open = 0.0f, left = 0.0f;
  for (std::size_t k = 0; k < corners.count; ++k) {
    if (corners.seen[k]->buried) continue;
    open += 1.0f, left += corners.weights[k];
  }
  if (open == 0.0f) return corners;
  Corners used = corners;
  for (std::size_t k = 0; k < corners.count; ++k) {
    float& weight = used.weights[k];
    // Between buried corners the others speak.
    weight = corners.seen[k]->buried ? 0.0f : left > 1e-3f ? weight / left : 1.0f / open;
  }
  return used;
}

SightTest::SightTest(const trace::RayScene& rays, int bands, std::uint64_t seed)
    : rays_(rays),
      bands_(bands),
      sets_{trace::DirectionSet(Sight::kDirections, math::randomRotation(2 * seed)),
            trace::DirectionSet(Sight::kDirections, math::randomRotation(2 * seed + 1))},
      tables_{transport::DirectionTable(sets_[0], bands),
              transport::DirectionTable(sets_[1], bands)} {}

Sight SightTest::at(const Spot& spot, Scratch& scratch) const {
  Sight sight;
  sight.normal = spot.normal;
  std::size_t above = 0, backs = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    trace::castClosest(rays_, sets_[s], spot.origin, spot.normal, scratch.cast);
    above += scratch.cast.raysCast;
    for (const trace::DirectionHit& hit : scratch.cast.hits) backs += hit.backFace ? 1 : 0;
    for (const std::uint32_t d : scratch.cast.visibleDirections()) {
      const std::size_t bit = s * kSet + d;
      sight.open[bit / 64] |= std::uint64_t(1) << (bit % 64);
    }
  }
  sight.buried = 2 * backs > above;
  return sight;
}

double SightTest::squaredError(const Sight& here, const Corners& corners, const Vec3& planeNormal,
                               Scratch& scratch, Compared compared) const {
  const bool open = compared == Compared::Arriving;
  for (std::size_t s = 0; s < 2; ++s) {
    scratch.ids.clear(), scratch.weights.clear();
    for (std::uint32_t d = 0; d < kSet; ++d) {
      const Vec3& direction = sets_[s][d];
      if (planeNormal.dot(direction) <= 0.0f) continue;
      const std::size_t bit = s * kSet + d;
      float difference = cosineWhere(open, here, bit, direction);
      for (std::size_t k = 0; k < corners.count; ++k)
        difference -= corners.weights[k] * cosineWhere(open, *corners.seen[k], bit, direction);
      if (std::abs(difference) < 1e-5f) continue;  // rounding
      scratch.ids.push_back(d), scratch.weights.push_back(difference);
    }
    const transport::Rows rows = tables_[s].rows();
    scratch.sums[s].assign(rows.stride, 0.0);
    if (scratch.ids.empty()) return 0.0;
    transport::addRows(rows, scratch.ids, scratch.weights, scratch.sums[s].data());
  }
  const double each = sets_[0].weight() / kPi;
  double squared = 0.0;
  for (int l = 0; l < bands_; ++l) {
    double band = 0.0;
    for (int m = -l; m <= l; ++m) {
      const auto i = static_cast<std::size_t>(sh::index(l, m));
      band += scratch.sums[0][i] * scratch.sums[1][i];
    }
    squared += band * 4.0 * kPi / (bands_ * (2.0 * l + 1.0));
  }
  return each * each * squared;
}

}  // namespace lambent::macro
