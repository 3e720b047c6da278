#include "lambent/synthesis/meso_graph.h"

namespace lambent::synthesis {

MesoGraph::MesoGraph(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets,
                     std::uint32_t nearest)
    : begin(mesh.levelEnd[level] + 1, 0) {
  const MesoMesh::Level& l = mesh.levels[level];
  std::vector<std::uint32_t> fill(mesh.levelEnd[level], 0);
  const auto end = [&](std::uint32_t v) {
    return l.begin[v] + std::min(nearest, l.begin[v + 1] - l.begin[v]);
  };
  for (std::uint32_t v = 0; v < fill.size(); ++v)
    for (std::uint32_t e = l.begin[v]; e < end(v); ++e) ++fill[l.neighbours[e]];
  for (std::uint32_t v = 0; v < fill.size(); ++v)
    begin[v + 1] = begin[v] + fill[v] + end(v) - l.begin[v];
  edges.resize(begin.back());
  std::copy(begin.begin(), begin.end() - 1, fill.begin());
  for (std::uint32_t v = 0; v < fill.size(); ++v) {
    for (std::uint32_t e = l.begin[v]; e < end(v); ++e) {
      const std::uint32_t to = l.neighbours[e];
      const float length = (mesh.positions[to] - mesh.positions[v]).norm();
      edges[fill[v]++] = {to, offsets[e], length};
      edges[fill[to]++] = {v, -offsets[e], length};
    }
  }
  // Those that are each other's neighbours have met twice.
  std::uint32_t kept = 0;
  for (std::uint32_t v = 0; v < fill.size(); ++v) {
    const auto first = edges.begin() + begin[v], last = edges.begin() + begin[v + 1];
    std::sort(first, last, [](const Edge& a, const Edge& b) {
      return a.length != b.length ? a.length < b.length : a.to < b.to;
    });
    begin[v] = kept;
    for (auto e = first; e != last; ++e)
      if (e == first || e->to != (e - 1)->to) edges[kept++] = *e;
  }
  begin.back() = kept;
  edges.resize(kept);
}

}  // namespace lambent::synthesis
