// This work is based on:
// - wei2008parallel: Poisson-disk sampling in cells no smaller than the radius, in phases of cells
//   that cannot see each other, so that all cells of a phase run at once and the result does not
//   depend on the number of threads (§3); coarse levels first, so that levels are nested.
// - burley2020practical: candidates by an Owen-scrambled Sobol sequence, so that few of them fill
//   the surface evenly.
//
// Where we deviate: candidates are drawn beforehand, six for each sample that is wanted, the same
// ones for every level; and distance along the normal counts twice, so that sheets that lie close
// over each other are filled one by one.
#include "lambent/synthesis/surface_samples.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/work/parallel_for.h"
#include "lambent/work/parallel_sort.h"

namespace lambent::synthesis {
namespace {

constexpr std::uint32_t kCandidates = 6;  ///< for each sample
/// N r² / area that six candidates each reach on a plane (measured; a plane filled to the brim by
/// chance has 0.70).
constexpr double kFill = 0.555;

std::vector<SurfaceSample> candidates(const scene::Mesh& mesh, const std::vector<double>& sums,
                                      std::uint32_t count, std::uint64_t seed) {
  std::vector<SurfaceSample> all(count);
  const auto sobolSeed = std::uint32_t(math::hashCombine(seed, 0x5a3eu));
  work::parallelFor(count, [&](std::uint32_t i) {
    // One number chooses the triangle, and what it has left over a place along its side.
    const Vec2 s = math::sobol2(i, sobolSeed);
    const double target = double(s.x()) * sums.back();
    const auto t =
        std::size_t(std::upper_bound(sums.begin(), sums.end() - 1, target) - sums.begin());
    const double before = t == 0 ? 0.0 : sums[t - 1];
    const double left = std::clamp((target - before) / (sums[t] - before), 0.0, 1.0);
    const float root = std::sqrt(float(left));
    SurfaceSample& c = all[i];
    c.triangle = std::uint32_t(t);
    c.u = root * (1.0f - s.y());
    c.v = root * s.y();
    const auto& [a, b, d] = mesh.triangles[t];
    c.position =
        (1.0f - c.u - c.v) * mesh.positions[a] + c.u * mesh.positions[b] + c.v * mesh.positions[d];
  });
  return all;
}

/// 21 bits, each followed by two zeros.
std::uint64_t spreadBits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

/// The cells of one level, sorted along a space-filling curve, and the candidates in each.
class Cells {
 public:
  Cells(const std::vector<SurfaceSample>& all, std::uint32_t count, const Vec3& lower,
        double radius)
      : sorted_(count) {
    const auto cellOf = [&](const Vec3& p) {
      std::array<std::uint32_t, 3> c;
      for (int k = 0; k < 3; ++k) {
        const double x = (double(p[k]) - double(lower[k])) / radius;
        c[std::size_t(k)] = std::uint32_t(std::clamp(x, 0.0, 2097149.0)) + 1;
      }
      return c;
    };
    work::parallelFor(count, [&](std::uint32_t i) {
      sorted_[i] = {key(cellOf(all[i].position)), i};
    });
    work::parallelSort(sorted_);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i == 0 || sorted_[i].first != sorted_[i - 1].first) begin_.push_back(i);
    }
    const auto cells = std::uint32_t(begin_.size());
    begin_.push_back(count);
    std::size_t size = 16;
    while (size < 2 * std::size_t(cells)) size *= 2;
    table_.assign(size, kNone);
    for (std::uint32_t c = 0; c < cells; ++c) {
      std::size_t slot = math::mix64(keyOf(c)) & (size - 1);
      while (table_[slot] != kNone) slot = (slot + 1) & (size - 1);
      table_[slot] = c;
    }
    around_.resize(cells);
    phases_.resize(8);
    work::parallelFor(cells, [&](std::uint32_t c) {
      const auto at = cellOf(all[sorted_[begin_[c]].second].position);
      std::size_t n = 0;
      for (std::uint32_t x = at[0] - 1; x <= at[0] + 1; ++x)
        for (std::uint32_t y = at[1] - 1; y <= at[1] + 1; ++y)
          for (std::uint32_t z = at[2] - 1; z <= at[2] + 1; ++z) around_[c][n++] = find({x, y, z});
    });
    for (std::uint32_t c = 0; c < cells; ++c) phases_[keyOf(c) & 7].push_back(c);
  }

  std::uint32_t begin(std::uint32_t cell) const { return begin_[cell]; }
  std::uint32_t end(std::uint32_t cell) const { return begin_[cell + 1]; }
  std::uint32_t count() const { return std::uint32_t(around_.size()); }
  std::uint32_t candidate(std::uint32_t place) const { return sorted_[place].second; }
  const std::array<std::uint32_t, 27>& around(std::uint32_t cell) const { return around_[cell]; }
  /// Cells whose coordinates are even or odd alike: two of them are never neighbours.
  const std::vector<std::vector<std::uint32_t>>& phases() const { return phases_; }

 private:
  static std::uint64_t key(const std::array<std::uint32_t, 3>& c) {
    return spreadBits(c[0]) | spreadBits(c[1]) << 1 | spreadBits(c[2]) << 2;
  }
  std::uint64_t keyOf(std::uint32_t cell) const { return sorted_[begin_[cell]].first; }
  std::uint32_t find(const std::array<std::uint32_t, 3>& c) const {
    const std::uint64_t k = key(c);
    std::size_t slot = math::mix64(k) & (table_.size() - 1);
    while (table_[slot] != kNone && keyOf(table_[slot]) != k) {
      slot = (slot + 1) & (table_.size() - 1);
    }
    return table_[slot];
  }

  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
  std::vector<std::uint32_t> begin_, table_;
  std::vector<std::array<std::uint32_t, 27>> around_;
  std::vector<std::vector<std::uint32_t>> phases_;
};

}  // namespace

Result<SurfaceSamples> spreadOver(const scene::Mesh& mesh, const Manifold& manifold,
                                  const std::vector<Vec3>& faceNormals, std::uint32_t count,
                                  int levels, std::uint64_t seed, const Progress& progress) {
  assert(levels >= 1 && count >= 1 && faceNormals.size() == mesh.triangles.size());
  std::vector<double> sums(mesh.triangles.size());
  Vec3 lower = Vec3::Constant(std::numeric_limits<float>::infinity());
  double area = 0.0;
  for (std::uint32_t t = 0; t < sums.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d p = mesh.positions[a].cast<double>();
    if (manifold.vertexOfCorner[3 * t] != kNone) {
      area +=
          0.5 *
          (mesh.positions[b].cast<double>() - p).cross(mesh.positions[c].cast<double>() - p).norm();
    }
    sums[t] = area;
    for (std::uint32_t v : mesh.triangles[t]) lower = lower.cwiseMin(mesh.positions[v]);
  }
  if (!(area > 0.0) || !std::isfinite(area)) {
    return report::badInput("the mesh " + mesh.name + " has no area to spread texture over");
  }
  // Triangles at the end that have no area must not be found by the search.
  while (sums.size() > 1 && !(sums[sums.size() - 1] > sums[sums.size() - 2])) sums.pop_back();

  SurfaceSamples result;
  result.area = area;
  const std::vector<SurfaceSample> all = candidates(mesh, sums, kCandidates * count, seed);
  std::vector<std::uint8_t> accepted(all.size(), 0);
  const auto hinders = [&](const SurfaceSample& a, const SurfaceSample& b, float radius) {
    const Vec3 d = b.position - a.position;
    const float d2 = d.squaredNorm();
    if (d2 >= radius * radius) return false;
    if (a.triangle == b.triangle) return true;
    const Vec3& na = faceNormals[a.triangle];
    const Vec3& nb = faceNormals[b.triangle];
    const float cosine = na.dot(nb);
    if (cosine < -0.2f) return false;
    if (manifold.componentOfTriangle(a.triangle) != manifold.componentOfTriangle(b.triangle)) {
      return false;
    }
    const float along = d.dot(na + nb);
    return d2 + 3.0f * along * along / (2.0f + 2.0f * cosine) < radius * radius;
  };

  for (int level = 0; level < levels; ++level) {
    if (progress && !progress({"meso-mesh", std::uint64_t(level), std::uint64_t(levels), "levels"}))
      return report::cancelled();
    const auto wanted =
        std::uint32_t(std::max(1.0, std::round(double(count) / std::pow(4.0, levels - 1 - level))));
    const double radius = std::sqrt(kFill * area / wanted);
    const Cells cells(all, kCandidates * wanted, lower, radius);
    std::vector<std::uint32_t> head(cells.count(), kNone);
    std::vector<std::uint32_t> following(std::size_t(kCandidates) * wanted, kNone);
    // Samples by place in the cells' sequence, so that what is near lies near in memory.
    std::vector<SurfaceSample> local(following.size());
    std::vector<std::uint8_t> old(following.size(), 0);
    work::parallelFor(cells.count(), [&](std::uint32_t c) {
      for (std::uint32_t i = cells.begin(c); i < cells.end(c); ++i) {
        local[i] = all[cells.candidate(i)];
        if (accepted[cells.candidate(i)]) {
          old[i] = 1;
          following[i] = head[c];
          head[c] = i;
        }
      }
    });
    // The first two candidates of each cell have their turn before the rest, so that no phase's
    // cells are filled to the brim while others are still empty.
    for (std::uint32_t turn = 0; turn < 3; ++turn) {
      for (const std::vector<std::uint32_t>& phase : cells.phases()) {
        work::parallelFor(phase.size(), [&](std::size_t k) {
          const std::uint32_t c = phase[k];
          const std::uint32_t from = std::min(cells.begin(c) + turn, cells.end(c));
          const std::uint32_t to = turn == 2 ? cells.end(c) : std::min(from + 1, cells.end(c));
          for (std::uint32_t i = from; i < to; ++i) {
            if (old[i]) continue;
            bool free = true;
            for (std::uint32_t other : cells.around(c)) {
              if (other == kNone) continue;
              for (std::uint32_t j = head[other]; j != kNone && free; j = following[j]) {
                free = !hinders(local[i], local[j], float(radius));
              }
              if (!free) break;
            }
            if (!free) continue;
            accepted[cells.candidate(i)] = 1;
            following[i] = head[c];
            head[c] = i;
          }
        });
      }
    }
    for (std::uint32_t i = 0; i < local.size(); ++i) {
      if (accepted[cells.candidate(i)] && !old[i]) result.samples.push_back(local[i]);
    }
    result.levelEnd.push_back(std::uint32_t(result.samples.size()));
  }
  return result;
}

}  // namespace lambent::synthesis
