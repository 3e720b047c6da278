#include "lambent/atlas/welded_surface.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lambent/scene/weld.h"

namespace lambent::atlas {
namespace {

/// A triangle whose height is below this share of its longest edge is a line: floats that are read
/// from files do not say which side of it is the front.
constexpr double kFlattest = 1e-7;

}  // namespace

WeldedSurface weldedSurface(const scene::Mesh& mesh) {
  WeldedSurface surface;
  const std::vector<std::uint32_t> ids = scene::weldPositions(mesh);
  for (std::size_t v = 0; v < ids.size(); ++v)
    if (ids[v] == surface.positions.size())
      surface.positions.push_back(mesh.positions[v].cast<double>());
  const std::size_t count = mesh.triangles.size();
  surface.triangles.resize(count);
  surface.neighbours.assign(count, {kNoTriangle, kNoTriangle, kNoTriangle});
  surface.normals.assign(count, Vec3d::Zero());
  surface.centroids.resize(count);
  surface.areas.assign(count, 0.0);

  struct Edge {
    std::uint64_t ends;
    std::uint32_t triangle;
    std::uint8_t side;
    bool upwards;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * count);
  for (std::uint32_t t = 0; t < count; ++t) {
    auto& v = surface.triangles[t];
    for (int k = 0; k < 3; ++k) v[k] = ids[mesh.triangles[t][k]];
    const Vec3d &a = surface.positions[v[0]], &b = surface.positions[v[1]],
                &c = surface.positions[v[2]];
    surface.centroids[t] = (a + b + c) / 3.0;
    const Vec3d doubled = (b - a).cross(c - a);
    const double size = doubled.norm();
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!(size > kFlattest * longest)) continue;
    surface.areas[t] = 0.5 * size;
    surface.area += 0.5 * size;
    surface.normals[t] = doubled / size;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = v[k], to = v[(k + 1) % 3];
      edges.push_back({std::uint64_t(std::min(from, to)) << 32 | std::max(from, to), t,
                       static_cast<std::uint8_t>(k), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.triangle < b.triangle;
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (end - i == 2 && edges[i].upwards != edges[i + 1].upwards) {
      surface.neighbours[edges[i].triangle][edges[i].side] = edges[i + 1].triangle;
      surface.neighbours[edges[i + 1].triangle][edges[i + 1].side] = edges[i].triangle;
    } else if (end - i >= 2) {
      ++surface.nonManifoldEdges;
    }
    i = end;
  }
  return surface;
}

}  // namespace lambent::atlas
