#include "lambent/atlas/welded_surface.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "lambent/scene/half_edges.h"
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
  }
  std::vector<std::uint8_t> leftOut;
  for (const double area : surface.areas) leftOut.push_back(!(area > 0.0));
  const scene::HalfEdges edges = scene::halfEdges(surface.triangles, leftOut);
  for (std::uint32_t h = 0; h < edges.twin.size(); ++h)
    if (edges.twin[h] != scene::HalfEdges::kNone)
      surface.neighbours[h / 3][h % 3] = edges.twin[h] / 3;
  surface.nonManifoldEdges = edges.nonManifoldEdges + edges.inconsistentEdges;
  return surface;
}

}  // namespace lambent::atlas
