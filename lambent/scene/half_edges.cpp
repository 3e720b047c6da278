#include "lambent/scene/half_edges.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

namespace lambent::scene {
namespace {

struct Use {
  std::uint64_t ends;
  std::uint32_t halfEdge;
  bool upwards;
};

/// Four triangles on two places beside the edge, both of which have one of either winding: which
/// two are one side of two sheets back to back, and which are the other.
std::optional<std::array<std::uint32_t, 4>> sidesOf(std::span<const Triangle> triangles,
                                                    std::span<const Use> uses) {
  const auto apex = [&](const Use& use) {
    return triangles[use.halfEdge / 3][std::size_t(use.halfEdge + 2) % 3];
  };
  const Use* of[2][2];  // [upwards][of two]
  int count[2] = {0, 0};
  for (const Use& use : uses) {
    if (count[use.upwards] == 2) return std::nullopt;
    of[use.upwards][count[use.upwards]++] = &use;
  }
  const std::uint32_t up = apex(*of[1][0]), otherUp = apex(*of[1][1]);
  if (up == otherUp) return std::nullopt;
  if (apex(*of[0][0]) == up) std::swap(of[0][0], of[0][1]);
  if (apex(*of[0][0]) != otherUp || apex(*of[0][1]) != up) return std::nullopt;
  return std::array{of[1][0]->halfEdge, of[0][0]->halfEdge, of[1][1]->halfEdge, of[0][1]->halfEdge};
}

}  // namespace

HalfEdges halfEdges(std::span<const Triangle> triangles, std::span<const std::uint8_t> leftOut) {
  assert(leftOut.size() == triangles.size());
  HalfEdges found;
  found.twin.assign(3 * triangles.size(), HalfEdges::kNone);
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (leftOut[t]) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      uses.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), 3 * t + k, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.halfEdge < b.halfEdge;
  });
  const auto join = [&](std::uint32_t a, std::uint32_t b) { found.twin[a] = b, found.twin[b] = a; };
  for (std::size_t i = 0, end; i < uses.size(); i = end) {
    end = i;
    while (end < uses.size() && uses[end].ends == uses[i].ends) ++end;
    const std::span<const Use> here(uses.data() + i, end - i);
    if (here.size() == 1) {
      ++found.borderEdges;
    } else if (here.size() == 2 && here[0].upwards != here[1].upwards) {
      join(here[0].halfEdge, here[1].halfEdge);
    } else if (here.size() == 2) {
      ++found.inconsistentEdges;
    } else if (const auto sides = here.size() == 4 ? sidesOf(triangles, here) : std::nullopt) {
      join((*sides)[0], (*sides)[1]);
      join((*sides)[2], (*sides)[3]);
    } else {
      ++found.nonManifoldEdges;
    }
  }
  return found;
}

}  // namespace lambent::scene
