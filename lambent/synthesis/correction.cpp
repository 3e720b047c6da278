// This work is based on:
// - tong2002synthesis (§4): k-coherence. Candidates for a vertex are its neighbours' places, moved
//   on by the way from the neighbour to the vertex, and the k places most similar to each.
// - lefebvre2005parallel (§3.2): correction in sub-passes of vertices that run at once.
// - ashikhmin2001natural: continuation is preferred over similarity, which keeps whole pieces of
//   the patch together.
//
// Where we deviate: a place is continuous, and where all neighbours expect nearly the same one a
// vertex takes their mean. That lets the patch bend a little where the tangent field turns, instead
// of breaking, and leaves the search for the few vertices that lie at a joint.
#include "lambent/synthesis/correction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

constexpr std::size_t kMostNeighbours = 64;
constexpr float kStrain = 0.3f;  ///< by which a continuation may be stretched or sheared
constexpr float kJump = 1.3f;    ///< how much better than continuation a similar place must fit
constexpr float kStray = 0.05f;  ///< cost of a neighbour off its continuation, of the variance

}  // namespace

Correction::Correction(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets,
                       const PatchLevel& patch, const Vec2& patchSize)
    : mesh_(mesh), level_(level), offsets_(offsets), patch_(patch), patchSize_(patchSize) {
  least_ = 0.15f * mesh.spacing(level);
  stray_ = kStray * patch.variance();
  for (std::uint32_t v = 0; v < mesh.levelEnd[level]; ++v) {
    classes_[math::mix64(v + 0x9e37u) & 3].push_back(v);
  }
}

Vec2 Correction::corrected(std::uint32_t vertex, const std::vector<Vec2>& q) const {
  const std::span<const std::uint32_t> neighbours = mesh_.neighbours(level_, vertex);
  const Vec2* offsets = offsets_.data() + mesh_.levels[level_].begin[vertex];
  const std::size_t count = std::min(neighbours.size(), kMostNeighbours);
  if (count == 0) return q[vertex];
  const Vec2 own = q[vertex];
  std::array<Vec2, kMostNeighbours> expected;  // where each neighbour expects the vertex, near own
  std::array<float, kMostNeighbours> tolerances;  // metres, by how far the neighbour is
  const auto metres = [&](const Vec2& d) { return d.cwiseProduct(patchSize_).norm(); };
  Vec2 mean = Vec2::Zero();
  bool together = true;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 d = wrapped(q[neighbours[k]] - offsets[k] - own);
    expected[k] = own + d;
    tolerances[k] = std::max(least_, kStrain * metres(offsets[k]));
    together = together && metres(d) <= tolerances[k];
    mean += d;
  }
  if (together) return intoPatch(own + mean / float(count));

  std::array<PatchLevel::Descriptor, kMostNeighbours> looks;
  std::array<float, kMostNeighbours> weights;
  const float nearest = (mesh_.positions[neighbours[0]] - mesh_.positions[vertex]).squaredNorm();
  for (std::size_t k = 0; k < count; ++k) {
    patch_.descriptor(q[neighbours[k]], looks[k]);
    const float d2 = (mesh_.positions[neighbours[k]] - mesh_.positions[vertex]).squaredNorm();
    weights[k] = std::exp(-0.5f * d2 / std::max(4.0f * nearest, 1e-30f));
  }
  float bestCost = std::numeric_limits<float>::infinity();
  Vec2 best = own;
  const auto consider = [&](const Vec2& candidate, float factor) {
    float cost = 0.0f;
    for (std::size_t k = 0; k < count && cost * factor < bestCost; ++k) {
      const float off = metres(wrapped(candidate - expected[k])) / tolerances[k];
      cost += weights[k] * (patch_.distance(candidate + offsets[k], looks[k]) +
                            stray_ * std::min(off * off, 1.0f));
    }
    if (cost * factor < bestCost) bestCost = cost * factor, best = candidate;
  };
  consider(own, 1.0f);
  std::array<Vec2, kMostNeighbours> distinct;
  std::size_t distinctCount = 0;
  for (std::size_t k = 0; k < count; ++k) {
    bool known = false;
    for (std::size_t l = 0; l < distinctCount && !known; ++l) {
      known = metres(wrapped(expected[k] - distinct[l])) <= least_;
    }
    if (known) continue;
    distinct[distinctCount++] = expected[k];
    consider(expected[k], 1.0f);
  }
  for (std::size_t l = 0; l < distinctCount; ++l) {
    for (int k = 0; k < patch_.similarCount(); ++k) consider(patch_.similar(distinct[l], k), kJump);
  }
  // The mean of those that expect the winner.
  Vec2 sum = Vec2::Zero();
  float total = 1.0f;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 d = wrapped(expected[k] - best);
    if (metres(d) <= tolerances[k]) sum += d, total += 1.0f;
  }
  return intoPatch(best + sum / total);
}

void Correction::pass(std::vector<Vec2>& q) const {
  std::vector<Vec2> next;
  for (const std::vector<std::uint32_t>& members : classes_) {
    next.resize(members.size());
    constexpr std::size_t kGrain = 512;
    work::parallelRanges(members.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) next[m] = corrected(members[m], q);
    });
    work::parallelRanges(members.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) q[members[m]] = next[m];
    });
  }
}

}  // namespace lambent::synthesis
