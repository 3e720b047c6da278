#include <algorithm>

#include <Eigen/Geometry>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/weld.h"

namespace lambent::scene {
Topology topology(const Mesh& mesh) {
  Topology result;
  const std::vector<std::uint32_t> ids = weldPositions(mesh);
  const Vec3d origin =
      mesh.positions.empty() ? Vec3d(Vec3d::Zero()) : Vec3d(mesh.positions[0].cast<double>());

  // Every directed edge as (smaller, larger, direction); sorted, equal undirected edges are
  // neighbours.
  struct Edge {
    std::uint64_t ends;
    bool upwards;
    bool operator<(const Edge& other) const { return ends < other.ends; }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  std::vector<bool> used(ids.size());
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t v[3] = {ids[t[0]], ids[t[1]], ids[t[2]]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3];
      edges.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), a < b});
      if (!used[a]) used[a] = true, ++result.vertices;
    }
    const Vec3d a = mesh.positions[t[0]].cast<double>() - origin;
    const Vec3d b = mesh.positions[t[1]].cast<double>() - origin;
    const Vec3d c = mesh.positions[t[2]].cast<double>() - origin;
    result.signedVolume += a.dot(b.cross(c)) / 6.0;
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    int upwards = 0;
    while (end < edges.size() && edges[end].ends == edges[i].ends) upwards += edges[end++].upwards;
    const std::size_t count = end - i;
    ++result.edges;
    if (count == 1) ++result.boundaryEdges;
    if (count > 2) ++result.nonManifoldEdges;
    if (count == 2 && upwards != 1) ++result.inconsistentEdges;
    i = end;
  }
  return result;
}

}  // namespace lambent::scene
