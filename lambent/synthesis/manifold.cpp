#include "lambent/synthesis/manifold.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "lambent/scene/weld.h"

namespace lambent::synthesis {
namespace {

void pairHalfEdges(const std::vector<std::uint32_t>& welded,
                   const std::vector<scene::Triangle>& triangles, Manifold& m) {
  struct SharedEdge {
    std::uint64_t ends;
    std::uint32_t halfEdge;
    bool upwards;
  };
  std::vector<SharedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    std::uint32_t v[3];
    for (int k = 0; k < 3; ++k) {
      assert(triangles[t][k] < welded.size());
      v[k] = welded[triangles[t][k]];
    }
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++m.degenerateTriangles;
      continue;
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3];
      edges.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), 3 * t + k, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const SharedEdge& a, const SharedEdge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.halfEdge < b.halfEdge;
  });
  for (std::size_t i = 0, end; i < edges.size(); i = end) {
    end = i;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (end - i == 1) {
      ++m.borderEdges;
    } else if (end - i > 2) {
      ++m.nonManifoldEdges;
    } else if (edges[i].upwards == edges[i + 1].upwards) {
      ++m.inconsistentEdges;
    } else {
      m.twin[edges[i].halfEdge] = edges[i + 1].halfEdge;
      m.twin[edges[i + 1].halfEdge] = edges[i].halfEdge;
    }
  }
}

}  // namespace

Manifold manifoldOf(const scene::Mesh& mesh) {
  Manifold m;
  const auto corners = std::uint32_t(3 * mesh.triangles.size());
  m.vertexOfCorner.assign(corners, kNone);
  m.twin.assign(corners, kNone);
  const std::vector<std::uint32_t> welded = scene::weldPositions(mesh);
  pairHalfEdges(welded, mesh.triangles, m);

  for (std::uint32_t c = 0; c < corners; ++c) {
    if (m.vertexOfCorner[c] != kNone) continue;
    const scene::Triangle& t = mesh.triangles[c / 3];
    if (welded[t[0]] == welded[t[1]] || welded[t[1]] == welded[t[2]] ||
        welded[t[2]] == welded[t[0]]) {
      continue;
    }
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
