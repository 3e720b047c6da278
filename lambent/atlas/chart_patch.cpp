#include "lambent/atlas/chart_patch.h"

#include <algorithm>

#include "lambent/math/union_find.h"

namespace lambent::atlas {
namespace {

/// A hole is closed if its border is below this share of the chart's outer border; a longer one
/// makes an annulus, which is cut.
constexpr double kHole = 0.3;

double lengthOf(const std::vector<std::uint32_t>& loop, const std::vector<Vec3d>& positions) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (positions[loop[i]] - positions[loop[(i + 1) % loop.size()]]).norm();
  return length;
}

}  // namespace

ChartPatch chartPatch(const WeldedSurface& surface, const Chart& chart,
                      const std::vector<std::uint32_t>& chartOf,
                      std::vector<std::uint32_t>& numberOf) {
  ChartPatch patch;
  patch.chartTriangles = chart.size();
  const std::uint32_t id = chartOf[chart.front()];
  for (std::uint32_t i = 0; i < chart.size(); ++i) numberOf[chart[i]] = i;

  // Corners that meet across an edge inside of the chart are one vertex.
  math::UnionFind corners(3 * chart.size());
  std::size_t innerSides = 0;
  const auto across = [&](std::uint32_t i, int k) {
    const std::uint32_t n = surface.neighbours[chart[i]][k];
    return n == kNoTriangle || chartOf[n] != id ? kNoTriangle : numberOf[n];
  };
  const auto cornerOf = [&](std::uint32_t i, std::uint32_t vertex) {
    const auto& v = surface.triangles[chart[i]];
    return 3 * i + (v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2);
  };
  for (std::uint32_t i = 0; i < chart.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t j = across(i, k);
      if (j == kNoTriangle) continue;
      ++innerSides;
      const auto& v = surface.triangles[chart[i]];
      corners.join(3 * i + k, cornerOf(j, v[k]));
      corners.join(3 * i + (k + 1) % 3, cornerOf(j, v[(k + 1) % 3]));
    }
  std::vector<std::uint32_t> vertexOf(3 * chart.size(), kNoTriangle);
  patch.triangles.resize(chart.size());
  for (std::uint32_t i = 0; i < chart.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& vertex = vertexOf[corners.rootOf(3 * i + k)];
      if (vertex == kNoTriangle) {
        vertex = static_cast<std::uint32_t>(patch.positions.size());
        patch.weldedVertex.push_back(surface.triangles[chart[i]][k]);
        patch.positions.push_back(surface.positions[patch.weldedVertex.back()]);
      }
      patch.triangles[i][k] = vertex;
    }

  // Around every vertex there is one fan now, so that each border vertex has one successor.
  std::vector<std::uint32_t> next(patch.positions.size(), kNoTriangle);
  std::size_t borderSides = 0;
  for (std::uint32_t i = 0; i < chart.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (across(i, k) == kNoTriangle) {
        next[patch.triangles[i][k]] = patch.triangles[i][(k + 1) % 3];
        ++borderSides;
      }
  for (std::uint32_t v = 0; v < next.size(); ++v) {
    if (next[v] == kNoTriangle) continue;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t at = v; next[at] != kNoTriangle;) {
      loop.push_back(at);
      const std::uint32_t after = next[at];
      next[at] = kNoTriangle;
      at = after;
    }
    patch.loops.push_back(std::move(loop));
  }
  if (patch.loops.empty()) return patch;
  std::vector<std::pair<double, std::size_t>> lengths;
  for (std::size_t l = 0; l < patch.loops.size(); ++l)
    lengths.emplace_back(-lengthOf(patch.loops[l], patch.positions), l);
  std::sort(lengths.begin(), lengths.end());
  std::vector<std::vector<std::uint32_t>> sorted;
  for (const auto& [length, l] : lengths) sorted.push_back(std::move(patch.loops[l]));
  patch.loops = std::move(sorted);

  // Euler: a piece of a sphere with b borders has V − E + F = 2 − b.
  const std::int64_t euler = std::int64_t(patch.positions.size()) -
                             std::int64_t(innerSides / 2 + borderSides) +
                             std::int64_t(chart.size());
  patch.disc = euler == 2 - std::int64_t(patch.loops.size());
  for (std::size_t l = 1; l < patch.loops.size() && patch.disc; ++l)
    patch.disc = lengths[l].first >= kHole * lengths[0].first;  // lengths are negative
  if (!patch.disc) return patch;
  for (std::size_t l = 1; l < patch.loops.size(); ++l) {
    const std::vector<std::uint32_t>& loop = patch.loops[l];
    Vec3d middle = Vec3d::Zero();
    for (const std::uint32_t v : loop) middle += patch.positions[v];
    const auto hub = static_cast<std::uint32_t>(patch.positions.size());
    patch.positions.push_back(middle / static_cast<double>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i)
      patch.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], hub});
  }
  return patch;
}

}  // namespace lambent::atlas
