#include "lambent/synthesis/manifold.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "lambent/scene/half_edges.h"
#include "lambent/scene/weld.h"

namespace lambent::synthesis {

Manifold manifoldOf(const scene::Mesh& mesh) {
  Manifold m;
  const auto corners = std::uint32_t(3 * mesh.triangles.size());
  m.vertexOfCorner.assign(corners, kNone);
  const std::vector<std::uint32_t> welded = scene::weldPositions(mesh);
  std::vector<scene::Triangle> triangles = mesh.triangles;
  std::vector<std::uint8_t> degenerate;
  for (scene::Triangle& t : triangles) {
    for (std::uint32_t& v : t) v = welded[v];
    degenerate.push_back(t[0] == t[1] || t[1] == t[2] || t[2] == t[0]);
    m.degenerateTriangles += degenerate.back();
  }
  scene::HalfEdges edges = scene::halfEdges(triangles, degenerate);
  m.twin = std::move(edges.twin);
  m.borderEdges = edges.borderEdges;
  m.nonManifoldEdges = edges.nonManifoldEdges;
  m.inconsistentEdges = edges.inconsistentEdges;

  for (std::uint32_t c = 0; c < corners; ++c) {
    if (m.vertexOfCorner[c] != kNone || degenerate[c / 3]) continue;
    std::uint32_t first = c;
    for (std::uint32_t right = m.turnRight(c); right != kNone && right != c;
         right = m.turnRight(right)) {
      first = right;
    }
    if (m.turnRight(first) != kNone) first = c;  // closed: any beginning will do
    const auto vertex = std::uint32_t(m.firstCorner.size());
    m.firstCorner.push_back(first);
    for (std::uint32_t a = first; a != kNone && m.vertexOfCorner[a] == kNone; a = m.turnLeft(a)) {
      m.vertexOfCorner[a] = vertex;
    }
  }

  std::vector<std::uint32_t> parent(m.vertexCount());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::uint32_t h = 0; h < corners; ++h) {
    if (m.vertexOfCorner[h] == kNone) continue;
    const std::uint32_t a = root(m.vertexOfCorner[h]);
    const std::uint32_t b = root(m.vertexOfCorner[Manifold::next(h)]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  m.componentOfVertex.resize(m.vertexCount());
  for (std::uint32_t v = 0; v < m.vertexCount(); ++v) {
    const std::uint32_t r = root(v);  // r ≤ v: numbered already
    m.componentOfVertex[v] = r == v ? m.components++ : m.componentOfVertex[r];
  }
  return m;
}

}  // namespace lambent::synthesis
