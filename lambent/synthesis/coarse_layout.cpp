// This work is based on:
// - knoppel2015stripe: a periodic coordinate over a surface is a phase at each vertex, whose
//   difference over each edge should be that of the tangent plane (§4). Its misfit is spread over
//   the surface, and what cannot be spread gathers in points where a period begins or ends.
// - lefebvre2005parallel (§3): randomness enters at coarse levels.
//
// Where we deviate: the phases are not an eigenvector but laid out from one vertex on and relaxed,
// so that the patch keeps its scale where it can. Randomness then cuts the surface into cells, each
// of which jumps to a place of the patch that looks like the one it had: a weave stays a weave.
#include "lambent/synthesis/coarse_layout.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "lambent/math/random.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

/// Visits all vertices of a level by rising distance over its edges from those given (distance 0),
/// and goes on at the least vertex not yet seen where components end: visit(vertex, from), `from`
/// the vertex that it was reached from or kNone.
template <class Visit>
void sweep(const MesoMesh& mesh, std::size_t level, const std::vector<std::uint32_t>& from,
           const Visit& visit) {
  struct Reached {
    float distance;
    std::uint32_t vertex, from;
    bool operator<(const Reached& other) const {  // the queue's top is its greatest
      return distance != other.distance ? distance > other.distance : vertex > other.vertex;
    }
  };
  std::vector<bool> seen(mesh.levelEnd[level], false);
  std::priority_queue<Reached> queue;
  const auto run = [&] {
    while (!queue.empty()) {
      const Reached at = queue.top();
      queue.pop();
      if (seen[at.vertex]) continue;
      seen[at.vertex] = true;
      visit(at.vertex, at.from);
      for (std::uint32_t j : mesh.neighbours(level, at.vertex)) {
        if (seen[j]) continue;
        queue.push(
            {at.distance + (mesh.positions[j] - mesh.positions[at.vertex]).norm(), j, at.vertex});
      }
    }
  };
  for (std::uint32_t v : from) queue.push({0.0f, v, kNone});
  run();
  for (std::uint32_t v = 0; v < seen.size(); ++v) {
    if (seen[v]) continue;
    queue.push({0.0f, v, kNone});
    run();
  }
}

/// Pieces of the surface about patch / (2·randomness) wide.
struct Cells {
  std::vector<std::uint32_t> cellOf;   ///< per vertex: that of its nearest centre
  std::vector<std::uint32_t> centres;  ///< per cell
};

Cells cellsOf(const MesoMesh& mesh, std::size_t level, const CoarseLayoutOptions& options) {
  const double patchArea = double(options.patchSize.x()) * double(options.patchSize.y());
  const double r = double(options.randomness);
  const double wanted = 4.0 * r * r * double(mesh.area) / patchArea;
  // The coarsest level that has enough vertices is evenly spread; thinned by chance.
  std::size_t source = 0;
  while (source < level && double(mesh.levelEnd[source]) < wanted) ++source;
  const double chance = wanted / double(mesh.levelEnd[source]);
  std::vector<std::uint32_t> centres;
  for (std::uint32_t v = 0; v < mesh.levelEnd[source]; ++v) {
    if (math::Random(options.seed, v, 0xce11u).uniformDouble() < chance) centres.push_back(v);
  }
  Cells cells;
  cells.cellOf.resize(mesh.levelEnd[level]);
  sweep(mesh, level, centres, [&](std::uint32_t v, std::uint32_t from) {
    cells.cellOf[v] = from == kNone ? std::uint32_t(cells.centres.size()) : cells.cellOf[from];
    if (from == kNone) cells.centres.push_back(v);
  });
  return cells;
}

/// The level's graph with every edge in both directions: nearest neighbours need not be mutual.
struct Edge {
  std::uint32_t to;
  Vec2 offset;
};
struct Graph {
  std::vector<std::uint32_t> begin;
  std::vector<Edge> edges;
  Graph(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets)
      : begin(mesh.levelEnd[level] + 1, 0) {
    const MesoMesh::Level& l = mesh.levels[level];
    std::vector<std::uint32_t> fill(mesh.levelEnd[level], 0);
    for (std::uint32_t j : l.neighbours) ++fill[j];
    for (std::uint32_t v = 0; v < fill.size(); ++v) {
      begin[v + 1] = begin[v] + fill[v] + l.begin[v + 1] - l.begin[v];
    }
    edges.resize(begin.back());
    std::copy(begin.begin(), begin.end() - 1, fill.begin());
    for (std::uint32_t v = 0; v < fill.size(); ++v) {
      for (std::uint32_t e = l.begin[v]; e < l.begin[v + 1]; ++e) {
        edges[fill[v]++] = {l.neighbours[e], offsets[e]};
        edges[fill[l.neighbours[e]]++] = {v, -offsets[e]};
      }
    }
  }
  std::span<const Edge> of(std::uint32_t v) const {
    return {edges.data() + begin[v], begin[v + 1] - begin[v]};
  }
};

/// Moves every vertex to where its neighbours expect it, many times over. A pull falls to nothing
/// at half a period, so that lines along which the layout does not meet dissolve into points.
void relax(const Graph& graph, int passes, std::vector<Vec2>& q) {
  std::vector<Vec2> next(q.size());
  const auto pull = [](float d) { return d * (1.0f - 4.0f * d * d); };  // ∝ about sin 2πd
  for (int pass = 0; pass < passes; ++pass) {
    work::parallelRanges(
        std::uint32_t(q.size()), 1024, [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t i = begin; i < end; ++i) {
            Vec2 sum = Vec2::Zero();
            for (const Edge& e : graph.of(i)) {
              const Vec2 d = wrapped(q[e.to] - e.offset - q[i]);
              sum += Vec2(pull(d.x()), pull(d.y()));
            }
            next[i] = q[i] + 0.8f / std::max(float(graph.of(i).size()), 1.0f) * sum;
          }
        });
    q.swap(next);
  }
}

/// Every cell of the surface jumps to a place of the patch that looks like the one its centre has.
/// All its vertices jump alike.
void scatter(const MesoMesh& mesh, std::size_t level, const PatchLevel& patch,
             const CoarseLayoutOptions& options, std::vector<Vec2>& q) {
  constexpr float kApart = 0.12f;  // of places from each other, in periods
  constexpr int kPlaces = 24;      // that a jump chooses among at most
  const Cells cells = cellsOf(mesh, level, options);
  std::vector<Vec2> jump(cells.centres.size());
  work::parallelFor(jump.size(), [&](std::size_t c) {
    const Vec2 from = q[cells.centres[c]];
    const std::vector<PatchLevel::Place> places = patch.mostSimilar(from, kPlaces, kApart);
    jump[c] = Vec2::Zero();
    if (places.empty()) return;
    // Randomness is also how much less alike a place may be than the one most alike; a few have
    // their chance however that is, or all cells with like centres would jump alike.
    const float most = places[0].distance + 0.5f * options.randomness * patch.windowVariance();
    std::size_t alike = std::min(places.size(), std::size_t(1.5f + 8.0f * options.randomness));
    while (alike < places.size() && places[alike].distance <= most) ++alike;
    math::Random random(options.seed, cells.centres[c], 0x10b9u);
    jump[c] = places[random.below(std::uint32_t(alike))].q - from;
  });
  for (std::size_t v = 0; v < q.size(); ++v) q[v] += jump[cells.cellOf[v]];
}

}  // namespace

std::vector<Vec2> coarseLayout(const MesoMesh& mesh, std::size_t level,
                               std::span<const Vec2> offsets, const PatchLevel& patch,
                               const CoarseLayoutOptions& options) {
  constexpr float kMeets = 0.1f;  // neighbours' predictions that count as one, in periods
  const Graph graph(mesh, level, offsets);
  std::vector<Vec2> q(mesh.levelEnd[level], Vec2::Zero());
  std::vector<bool> laid(q.size(), false);
  sweep(mesh, level, {}, [&](std::uint32_t v, std::uint32_t from) {
    laid[v] = true;
    if (from == kNone) {
      q[v] = math::Random(options.seed, v, 0x1a1du).uniform2();
      return;
    }
    const Edge* nearest = nullptr;
    for (const Edge& e : graph.of(v)) {
      const auto length = [&](const Edge& x) {
        return x.offset.cwiseProduct(options.patchSize).norm();
      };
      if (laid[e.to] && (!nearest || length(e) < length(*nearest))) nearest = &e;
    }
    const Vec2 first = q[nearest->to] - nearest->offset;
    Vec2 sum = Vec2::Zero();
    float weight = 0.0f;
    for (const Edge& e : graph.of(v)) {
      if (!laid[e.to]) continue;
      const Vec2 d = wrapped(q[e.to] - e.offset - first);
      if (d.cwiseAbs().maxCoeff() > kMeets) continue;
      sum += d, weight += 1.0f;
    }
    q[v] = first + sum / weight;
  });
  relax(graph, 200, q);
  if (options.randomness > 0.0f) scatter(mesh, level, patch, options, q);
  return q;
}

}  // namespace lambent::synthesis
