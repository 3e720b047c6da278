// This work is based on:
// - knoppel2015stripe: a periodic coordinate over a surface is a phase at each vertex, whose
//   difference over each edge should be that of the tangent plane (§4). Its misfit is spread over
//   the surface, and what cannot be spread gathers in points where a period begins or ends.
//
// Where we deviate: the phases are not an eigenvector but laid out from one vertex on and relaxed,
// so that the patch keeps its scale where it can.
#include "lambent/synthesis/coarse_layout.h"

#include <algorithm>

#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

/// Moves every vertex to where its neighbours expect it, many times over. A pull falls to nothing
/// at half a period, so that lines along which the layout does not meet dissolve into points.
void relax(const MesoGraph& graph, int passes, std::vector<Vec2>& q) {
  std::vector<Vec2> next(q.size());
  const auto pull = [](float d) { return d * (1.0f - 4.0f * d * d); };  // ∝ about sin 2πd
  for (int pass = 0; pass < passes; ++pass) {
    work::parallelRanges(
        std::uint32_t(q.size()), 1024, [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t i = begin; i < end; ++i) {
            Vec2 sum = Vec2::Zero();
            for (const MesoGraph::Edge& e : graph.of(i)) {
              const Vec2 d = wrapped(q[e.to] - e.offset - q[i]);
              sum += Vec2(pull(d.x()), pull(d.y()));
            }
            next[i] = q[i] + 0.8f / std::max(float(graph.of(i).size()), 1.0f) * sum;
          }
        });
    q.swap(next);
  }
}

}  // namespace

std::vector<Vec2> coarseLayout(const MesoGraph& graph, std::uint64_t seed) {
  std::vector<Vec2> q(graph.size(), Vec2::Zero());
  MesoGraph::Sweep sweep(graph);
  const auto lay = [&](std::uint32_t v, std::uint32_t from, float) {
    q[v] = from == kNone ? math::Random(seed, v, 0x1a1du).uniform2()
                         : graph.continuedTo(
                               v, [&](std::uint32_t j) { return sweep.seen(j) ? &q[j] : nullptr; });
    return true;
  };
  for (std::uint32_t v = 0; v < graph.size(); ++v)  // the first of each component
    if (!sweep.seen(v)) sweep.run({{v}}, lay);
  relax(graph, 200, q);
  return q;
}

}  // namespace lambent::synthesis
