#include "lambent/synthesis/meso_neighbours.h"

#include <algorithm>

#include <nanoflann.hpp>

#include "lambent/synthesis/point_tree.h"
#include "lambent/work/runner.h"

namespace lambent::synthesis {
namespace {

constexpr float kTurnedAway = -0.2f;  ///< least cosine between fronts of neighbours

float squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const float length2 = ab.squaredNorm();
  const float s = length2 > 0.0f ? std::clamp((p - a).dot(ab) / length2, 0.0f, 1.0f) : 0.0f;
  return (p - a - s * ab).squaredNorm();
}

/// Which triangles hang together with one, within a ball: a search over edges that stops as soon as
/// all that were asked for are found.
class Flood {
 public:
  explicit Flood(std::size_t triangles) : wanted_(triangles, 0), reached_(triangles, 0) {}

  void run(const scene::Mesh& mesh, const Manifold& m, std::uint32_t from, const Vec3& center,
           float radius2, std::span<const std::uint32_t> triangles) {
    ++stamp_;
    std::size_t left = 0;
    for (std::uint32_t t : triangles) {
      if (wanted_[t] == stamp_) continue;
      wanted_[t] = stamp_;
      ++left;
    }
    queue_.clear();
    const auto reach = [&](std::uint32_t t) {
      if (reached_[t] == stamp_) return;
      reached_[t] = stamp_;
      left -= wanted_[t] == stamp_;
      queue_.push_back(t);
    };
    reach(from);
    for (std::size_t i = 0; i < queue_.size() && left > 0; ++i) {
      const std::uint32_t t = queue_[i];
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t beyond = m.twin[h];
        if (beyond == kNone || reached_[beyond / 3] == stamp_) continue;
        const Vec3& a = mesh.positions[mesh.triangles[t][h - 3 * t]];
        const Vec3& b = mesh.positions[mesh.triangles[t][Manifold::next(h) - 3 * t]];
        if (squaredDistanceToSegment(center, a, b) <= radius2) reach(beyond / 3);
      }
    }
  }
  bool reached(std::uint32_t triangle) const { return reached_[triangle] == stamp_; }

 private:
  std::vector<std::uint32_t> wanted_, reached_;  ///< the run that they were marked in
  std::vector<std::uint32_t> queue_;
  std::uint32_t stamp_ = 0;
};

}  // namespace

MesoMesh::Level neighboursOf(const scene::Mesh& mesh, const Manifold& manifold,
                             const std::vector<Vec3>& faceNormals,
                             std::span<const SurfaceSample> samples, int wanted) {
  const auto count = std::uint32_t(samples.size());
  const Points points{samples.size(),
                      [&](std::size_t i) -> const Vec3& { return samples[i].position; }};
  const PointTree<decltype(points.position)> tree(3, points,
                                                  nanoflann::KDTreeSingleIndexAdaptorParams(12));
  // Some of the nearest may be another sheet's, and the first is the sample itself.
  const auto asked = std::min<std::size_t>(std::size_t(wanted) * 3 / 2 + 2, count);

  std::vector<std::uint32_t> table(std::size_t(count) * std::size_t(wanted), kNone);
  const auto search = [&](const work::Chunk& chunk, Flood& flood) {
    std::vector<std::uint32_t> found(asked), triangles(asked);
    std::vector<float> distances(asked);
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const SurfaceSample& own = samples[i];
      const std::size_t n =
          tree.knnSearch(own.position.data(), asked, found.data(), distances.data());
      if (n == 0) continue;
      triangles.clear();
      for (std::size_t k = 0; k < n; ++k) triangles.push_back(samples[found[k]].triangle);
      flood.run(mesh, manifold, own.triangle, own.position, distances[n - 1], triangles);
      const Vec3& normal = faceNormals[own.triangle];
      int kept = 0;
      for (std::size_t k = 0; k < n && kept < wanted; ++k) {
        if (found[k] == i || !flood.reached(triangles[k])) continue;
        if (normal.dot(faceNormals[triangles[k]]) < kTurnedAway) continue;
        table[i * std::size_t(wanted) + std::size_t(kept++)] = found[k];
      }
    }
  };
  // Nobody listens, so that nobody stops it.
  (void)work::Runner().run({}, work::Chunks(count, 256), Flood(mesh.triangles.size()), search);

  MesoMesh::Level level;
  level.begin.resize(std::size_t(count) + 1, 0);
  level.neighbours.reserve(table.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int k = 0; k < wanted; ++k) {
      const std::uint32_t j = table[std::size_t(i) * std::size_t(wanted) + std::size_t(k)];
      if (j == kNone) break;
      level.neighbours.push_back(j);
    }
    level.begin[i + 1] = std::uint32_t(level.neighbours.size());
  }
  return level;
}

}  // namespace lambent::synthesis
