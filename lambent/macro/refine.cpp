// This work is based on:
// - rivara1984algorithms: triangles are cut at their longest edges, and the neighbours there too.
//
// How it looks for shadows. A triangle is looked at in its middle, in the middles of its edges, and
// wherever a sample (surface_samples.h) lies in it: those lie where something stands before the
// surface, so that a floor of two triangles has the shadow of a small box found. Samples stay with
// the part of the triangle that they lie in. What was seen from the middle of an edge is what the
// new vertex sees when the edge is cut: each place is looked at once.
#include "lambent/macro/refine.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/macro/sight.h"
#include "lambent/macro/surface_samples.h"
#include "lambent/scene/split_edges.h"
#include "lambent/sh/basis.h"
#include "lambent/work/runner.h"

namespace lambent::macro {

namespace {

using transport::PlacedReceivers;

constexpr std::size_t kSamples = 8192;
constexpr float kLeastOfFeature = 1.0f / 128.0f;
/// Side of a patch over which the error is a root mean square, times the shortest edge.
constexpr double kWholeOfLeast = 32.0;
/// In one round those triangles are cut that matter at least so much of what the first one does.
constexpr double kLeastOfFirst = 1.0 / 16.0;

std::uint64_t endsOf(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

struct TriangleId {
  std::uint32_t mesh, triangle;
};

struct CornerPlaces {
  std::array<Vec3d, 3> at;

  CornerPlaces(const scene::Mesh& mesh, std::uint32_t triangle) {
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = mesh.positions[mesh.triangles[triangle][k]].cast<double>();
  }
  Vec3d cross() const { return (at[1] - at[0]).cross(at[2] - at[0]); }
  /// Of a point in the plane; zero for a triangle without area.
  Vec3d weightsOf(const Vec3d& point) const {
    const Vec3d whole = cross();
    const double square = whole.squaredNorm();
    if (!(square > 0.0)) return Vec3d::Zero();
    const double v = (point - at[0]).cross(at[2] - at[0]).dot(whole) / square;
    const double w = (at[1] - at[0]).cross(point - at[0]).dot(whole) / square;
    return Vec3d(1.0 - v - w, v, w);
  }
};

struct Sample {
  TriangleId in;
  Vec3d position;
  Sight sight;
};

/// e² at the places of a triangle that were looked at.
struct SquaredError {
  float mean = -1.0f;

  bool isKnown() const { return mean >= 0.0f; }
};

/// A triangle that is to be cut, and how much that matters.
struct Candidate {
  TriangleId id;
  double weight;  ///< mean of e² · area
};

class Refinement {
 public:
  Refinement(const scene::Scene& scene, const trace::RayScene& rays,
             const PlacedReceivers& receivers, const RefineOptions& options,
             const Progress& progress)
      : scene_(scene),
        rays_(rays),
        options_(options),
        test_(rays, options.bands, options.seed),
        runner_(progress, options.threads) {
    for (const PlacedReceivers::PerMesh& mesh : receivers.meshes)
      isLookedAt_.push_back(mesh.layout == transport::Layout::Vertices);
    middles_.resize(scene.meshes.size());
    vertices_.resize(scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
      squared_.emplace_back(scene.meshes[m].triangles.size());
  }

  Status begin(const PlacedReceivers& receivers) {
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
      if (!isLookedAt_[m]) continue;
      std::vector<Spot> spots;
      for (std::uint32_t v = 0; v < scene_.meshes[m].positions.size(); ++v) {
        const std::uint32_t r = receivers.meshes[m].first + v;
        spots.push_back({receivers.origins[r], receivers.normals[r]});
      }
      auto sights = look(spots);
      if (!sights) return sights.error();
      vertices_[m] = std::move(*sights);
    }
    const SurfaceSamples drawn = drawSamples(scene_, rays_, isLookedAt_, kSamples, options_.seed);
    std::vector<Spot> spots;
    for (const SurfaceSample& s : drawn.samples) {
      const scene::SurfacePoint point = scene::surfaceAt(scene_, s.mesh, s.triangle, s.u, s.v);
      spots.push_back({point.position + rays_.offset() * point.normal, point.normal});
      samples_.push_back({{s.mesh, s.triangle}, point.position.cast<double>(), {}});
    }
    auto sights = look(spots);
    if (!sights) return sights.error();
    for (std::size_t k = 0; k < samples_.size(); ++k) samples_[k].sight = (*sights)[k];
    leastEdge_ = drawn.feature > 0.0f ? kLeastOfFeature * drawn.feature
                                      : scene::bounds(scene_).diagonal() / 512.0f;
    wholeArea_ = std::pow(kWholeOfLeast * double(leastEdge_), 2);
    return Status::ok();
  }

  /// Looks into all triangles that are new.
  Status measure() {
    std::vector<TriangleId> unknown;
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m)
      for (std::uint32_t t = 0; isLookedAt_[m] && t < squared_[m].size(); ++t)
        if (!squared_[m][t].isKnown()) unknown.push_back({m, t});
    if (Status looked = lookAtMiddles(unknown); !looked) return looked;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> inside;  // triangle, sample
    for (std::uint32_t k = 0; k < samples_.size(); ++k)
      inside.emplace_back(std::uint64_t(samples_[k].in.mesh) << 32 | samples_[k].in.triangle, k);
    std::sort(inside.begin(), inside.end());
    return runner_.run({"refine", "points"}, work::Chunks(unknown.size(), 16), SightTest::Scratch(),
                       [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
                         for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
                           const auto [m, t] = unknown[k];
                           squared_[m][t] = errorOf({m, t}, inside, scratch);
                         }
                       });
  }

  /// Those that are further off than they may be and not too small, what matters most first.
  std::vector<Candidate> candidates(const scene::SceneEdges& edges) const {
    std::vector<Candidate> found;
    const double most = options_.error * options_.error;
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m)
      for (std::uint32_t t = 0; isLookedAt_[m] && t < squared_[m].size(); ++t) {
        const int longest = edges.longestOf(m, t);
        if (longest < 0) continue;
        const std::uint32_t edge = edges.ofTriangle[m][t][std::size_t(longest)];
        if (!(edges.lengths[edge] > leastEdge_)) continue;
        const double area = 0.5 * CornerPlaces(scene_.meshes[m], t).cross().norm();
        if (!(squared_[m][t].mean * std::min(area, wholeArea_) > most * wholeArea_)) continue;
        found.push_back({{m, t}, squared_[m][t].mean * area});
      }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
    std::size_t first = 0;
    while (first < found.size() && found[first].weight >= kLeastOfFirst * found[0].weight) ++first;
    found.resize(first);
    return found;
  }

  /// Cuts at marked edges, and keeps what is known.
  void cut(const scene::SceneEdges& edges, const std::vector<std::uint8_t>& marks) {
    scene::SplitScene split = scene::splitEdges(scene_, edges, marks);
    std::vector<std::vector<SquaredError>> squared;
    std::vector<std::vector<std::uint32_t>> firstChild;
    for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
      const std::vector<std::uint32_t>& parents = split.parentOf[m];
      firstChild.emplace_back(squared_[m].size() + 1, 0);
      for (const std::uint32_t p : parents) ++firstChild[m][p + 1];
      for (std::size_t p = 0; p < squared_[m].size(); ++p) firstChild[m][p + 1] += firstChild[m][p];
      squared.emplace_back();
      for (const std::uint32_t p : parents) {
        const bool whole = firstChild[m][p + 1] - firstChild[m][p] == 1;
        squared[m].push_back(whole ? squared_[m][p] : SquaredError());
      }
      if (!isLookedAt_[m]) continue;
      for (const scene::MiddleVertex& middle : split.middles[m]) {
        const auto known = middles_[m].find(endsOf(middle.a, middle.b));
        vertices_[m].push_back(known->second);
        middles_[m].erase(known);
      }
    }
    scene_ = std::move(split.scene);
    squared_ = std::move(squared);
    for (Sample& sample : samples_) {
      const auto [m, parent] = sample.in;
      double best = -1e30;
      for (std::uint32_t t = firstChild[m][parent]; t < firstChild[m][parent + 1]; ++t)
        if (const double inside =
                CornerPlaces(scene_.meshes[m], t).weightsOf(sample.position).minCoeff();
            inside > best)
          best = inside, sample.in.triangle = t;
    }
  }

  const scene::Scene& scene() const { return scene_; }
  scene::Scene take() { return std::move(scene_); }

 private:
  Result<std::vector<Sight>> look(const std::vector<Spot>& spots) const {
    return runner_.map({"refine", "points"}, work::Chunks(spots.size()), SightTest::Scratch(),
                       [&](const work::Chunk& chunk, SightTest::Scratch& scratch) {
                         return test_.at(spots[chunk.begin], scratch);
                       });
  }

  /// From the middles of the triangles' edges, where nobody looked yet.
  Status lookAtMiddles(const std::vector<TriangleId>& triangles) {
    std::vector<Spot> spots;
    std::vector<Sight*> places;  // nodes of unordered maps stay where they are
    for (const auto& [m, t] : triangles) {
      const scene::Mesh& mesh = scene_.meshes[m];
      const scene::Triangle& corners = mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
        const auto [place, isNew] = middles_[m].try_emplace(endsOf(a, b));
        if (!isNew) continue;
        const Vec3 middle = 0.5f * mesh.positions[a] + 0.5f * mesh.positions[b];
        const Vec3 along = (mesh.positions[b] - mesh.positions[a]).normalized();
        const Vec3 across = mesh.positions[c] - middle;
        const Vec3 inward = (across - across.dot(along) * along).normalized();
        Vec3 normal = mesh.normals[a] + mesh.normals[b];
        normal = normal.norm() > 1e-6f ? Vec3(normal.normalized()) : mesh.normals[a];
        // Off the edge too, as receivers are: another surface may begin there.
        spots.push_back({middle + rays_.offset() * (normal + inward), normal});
        places.push_back(&place->second);
      }
    }
    const auto sights = look(spots);
    if (!sights) return sights.error();
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = (*sights)[k];
    return Status::ok();
  }

  SquaredError errorOf(const TriangleId& id,
                       const std::vector<std::pair<std::uint64_t, std::uint32_t>>& inside,
                       SightTest::Scratch& scratch) const {
    const auto [m, t] = id;
    const scene::Mesh& mesh = scene_.meshes[m];
    const scene::Triangle& triangle = mesh.triangles[t];
    const CornerPlaces corners(mesh, t);
    const Vec3d cross = corners.cross();
    if (!(cross.norm() > 0.0)) return {0.0f};
    const Vec3 plane = cross.normalized().cast<float>();
    const std::array<const Sight*, 3> seen = {
        &vertices_[m][triangle[0]], &vertices_[m][triangle[1]], &vertices_[m][triangle[2]]};
    double sum = 0.0, count = 0.0;
    const auto compare = [&](const Sight& here, const Vec3& weights) {
      if (here.buried) return;
      // Where bodies touch, a bake sets buried corners so that what is seen is right.
      const Corners used = exposed(Corners::ofTriangle(seen, weights));
      const double error = test_.squaredError(here, used, plane, scratch);
      sum += std::max(0.0, error), count += 1.0;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 weights = Vec3::Constant(0.5f);
      weights[Eigen::Index((k + 2) % 3)] = 0.0f;
      compare(middles_[m].at(endsOf(triangle[k], triangle[(k + 1) % 3])), weights);
    }
    const scene::SurfacePoint middle = scene::surfaceAt(scene_, m, t, 1.0f / 3.0f, 1.0f / 3.0f);
    compare(test_.at({middle.position + rays_.offset() * middle.normal, middle.normal}, scratch),
            Vec3::Constant(1.0f / 3.0f));
    const std::uint64_t key = std::uint64_t(m) << 32 | t;
    for (auto at = std::lower_bound(inside.begin(), inside.end(), std::pair(key, 0u));
         at != inside.end() && at->first == key; ++at) {
      const Sample& sample = samples_[at->second];
      compare(sample.sight, corners.weightsOf(sample.position).cast<float>());
    }
    return {static_cast<float>(sum / std::max(1.0, count))};
  }

  scene::Scene scene_;
  const trace::RayScene& rays_;
  const RefineOptions& options_;
  SightTest test_;
  work::Runner runner_;
  std::vector<bool> isLookedAt_;                                   ///< [mesh]
  std::vector<std::vector<Sight>> vertices_;                       ///< [mesh][vertex]
  std::vector<std::unordered_map<std::uint64_t, Sight>> middles_;  ///< [mesh], of edges, by ends
  std::vector<std::vector<SquaredError>> squared_;                 ///< [mesh][triangle]
  std::vector<Sample> samples_;
  float leastEdge_ = 0.0f;
  double wholeArea_ = 0.0;  ///< m²: a smaller triangle may be further off, by its share of this
};

/// Marks, closed, of the longest edges of the first `count` candidates.
std::vector<std::uint8_t> marksOf(const scene::SceneEdges& edges,
                                  const std::vector<Candidate>& candidates, std::size_t count) {
  std::vector<std::uint8_t> marks(edges.size(), 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto [m, t] = candidates[k].id;
    marks[edges.ofTriangle[m][t][std::size_t(edges.longestOf(m, t))]] = 1;
  }
  scene::closeMarks(edges, marks);
  return marks;
}

}  // namespace

Result<Refined> refine(const scene::Scene& scene, const trace::RayScene& rays,
                       const PlacedReceivers& receivers, const RefineOptions& options,
                       const Progress& progress) {
  if (!(options.error > 0.0 && std::isfinite(options.error)))
    return report::badUsage("the error to refine to is " + std::to_string(options.error) +
                            ", not above 0");
  if (options.bands < 1 || options.bands > sh::kMaxBands)
    return report::badUsage("bands are " + std::to_string(options.bands) + ", not 1 to " +
                            std::to_string(sh::kMaxBands));
  Refinement refinement(scene, rays, receivers, options, progress);
  if (Status begun = refinement.begin(receivers); !begun) return begun.error();
  Refined refined;
  while (!refined.spent) {
    if (Status measured = refinement.measure(); !measured) return measured.error();
    const scene::SceneEdges edges = scene::edgesOf(refinement.scene());
    const std::vector<Candidate> candidates = refinement.candidates(edges);
    if (candidates.empty()) break;
    std::vector<std::uint8_t> marks = marksOf(edges, candidates, candidates.size());
    std::size_t added = scene::addedVertices(refinement.scene(), edges, marks);
    if (refined.added + added > options.budget) {
      refined.spent = true;
      std::size_t fits = 0, fitsNot = candidates.size();  // more marks never add less
      while (fits + 1 < fitsNot) {
        const std::size_t middle = (fits + fitsNot) / 2;
        const std::size_t there =
            scene::addedVertices(refinement.scene(), edges, marksOf(edges, candidates, middle));
        (refined.added + there > options.budget ? fitsNot : fits) = middle;
      }
      marks = marksOf(edges, candidates, fits);
      added = scene::addedVertices(refinement.scene(), edges, marks);
    }
    if (added > 0) refinement.cut(edges, marks);
    refined.added += added;
  }
  refined.scene = refinement.take();
  return refined;
}

}  // namespace lambent::macro
