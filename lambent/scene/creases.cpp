#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

#include "lambent/math/union_find.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/weld.h"

namespace lambent::scene {
namespace {

/// Facets that bend by less are one: what rounding of positions leaves.
constexpr double kFlat = 1e-3;
/// Edges of more triangles than this join none of them: what hangs together there is nobody's wish,
/// and looking at all pairs would take time without a bound.
constexpr std::size_t kMostAtAnEdge = 8;

struct Edge {
  std::uint64_t ends;    ///< smaller position's number above the larger one's
  std::uint32_t corner;  ///< where it begins, going around its triangle
  bool upwards;          ///< begins at the smaller
  bool operator<(const Edge& other) const {
    return ends != other.ends ? ends < other.ends : corner < other.corner;
  }
};

std::uint32_t nextCorner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

std::vector<Edge> edgesOf(const Mesh& mesh, const std::vector<std::uint32_t>& places) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Triangle& t = mesh.triangles[c / 3];
    const std::uint32_t a = places[t[c % 3]], b = places[t[nextCorner(c) % 3]];
    if (a == b) continue;
    edges.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), c, a < b});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

struct Facets {
  std::vector<Vec3d> normals;  ///< zero: no area
  std::vector<double> angles;  ///< by corner
};

Facets facetsOf(const Mesh& mesh) {
  Facets facets;
  facets.normals.reserve(mesh.triangles.size());
  facets.angles.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Vec3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh.positions[t[k]].cast<double>();
    const Vec3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const double area = cross.norm();
    facets.normals.push_back(area > 0.0 ? Vec3d(cross / area) : Vec3d(Vec3d::Zero()));
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      facets.angles.push_back(area > 0.0 ? std::atan2(area, a.dot(b)) : 0.0);
    }
  }
  return facets;
}

/// Corners that share a normal: of one place, and of triangles that hang together across edges
/// which bend by less than `angle`. Triangles without area bend nowhere. Corner c is corner c % 3
/// of triangle c / 3.
math::UnionFind groupCorners(const Mesh& mesh, const Facets& facets, double angle) {
  const double least = std::cos(std::min(std::max(angle, kFlat), 3.14159265358979));
  const std::vector<Edge> edges = edgesOf(mesh, weldPositions(mesh));
  math::UnionFind groups(3 * mesh.triangles.size());
  const auto smooth = [&](const Edge& a, const Edge& b) {
    const Vec3d &m = facets.normals[a.corner / 3], &n = facets.normals[b.corner / 3];
    return a.upwards != b.upwards && (m.isZero(0.0) || n.isZero(0.0) || m.dot(n) >= least);
  };
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].ends == edges[first].ends) ++end;
    if (end - first > kMostAtAnEdge) continue;
    for (std::size_t i = first; i < end; ++i) {
      for (std::size_t k = i + 1; k < end; ++k) {
        if (!smooth(edges[i], edges[k])) continue;
        groups.join(edges[i].corner, nextCorner(edges[k].corner));
        groups.join(nextCorner(edges[i].corner), edges[k].corner);
      }
    }
  }
  return groups;
}

template <class T>
void appendCopy(std::vector<T>& values, std::uint32_t of) {
  if (values.empty()) return;
  const T copy = values[of];
  values.push_back(copy);
}

}  // namespace

std::size_t creaseNormals(Mesh& mesh, float angle) {
  const Facets facets = facetsOf(mesh);
  math::UnionFind groups = groupCorners(mesh, facets, double(angle));
  const auto corners = std::uint32_t(3 * mesh.triangles.size());
  std::vector<Vec3d> sums(corners, Vec3d::Zero());  // by root
  for (std::uint32_t c = 0; c < corners; ++c) {
    sums[groups.rootOf(c)] += facets.angles[c] * facets.normals[c / 3];
  }
  constexpr std::uint32_t kNone = 0xffffffffu;
  mesh.normals.assign(mesh.positions.size(), Vec3::Zero());
  std::vector<std::uint32_t> rootOf(mesh.positions.size(), kNone);  // the first of each vertex
  std::unordered_map<std::uint64_t, std::uint32_t> others;
  std::size_t without = 0;
  for (std::uint32_t c = 0; c < corners; ++c) {
    std::uint32_t& vertex = mesh.triangles[c / 3][c % 3];
    const std::uint32_t root = groups.rootOf(c);
    if (rootOf[vertex] == root) continue;
    bool isNew = rootOf[vertex] == kNone;
    if (isNew) {
      rootOf[vertex] = root;
    } else {
      const auto key = std::uint64_t(vertex) << 32 | root;
      const auto [entry, added] = others.try_emplace(key, std::uint32_t(mesh.positions.size()));
      if (added) {
        appendCopy(mesh.positions, vertex);
        appendCopy(mesh.uvs, vertex);
        appendCopy(mesh.texelUvs, vertex);
        appendCopy(mesh.colors, vertex);
        appendCopy(mesh.alphas, vertex);
        copyVertex(mesh.others, vertex);
        mesh.normals.push_back(Vec3::Zero());
      }
      vertex = entry->second;
      isNew = added;
    }
    if (!isNew) continue;
    const double length = sums[root].norm();
    without += !(length > 1e-6);
    mesh.normals[vertex] =
        length > 1e-6 ? Vec3((sums[root] / length).cast<float>()) : Vec3(Vec3::UnitY());
  }
  for (Vec3& n : mesh.normals) {
    if (!n.isZero(0.0f)) continue;
    n = Vec3::UnitY();  // of no triangle
    ++without;
  }
  return without;
}

}  // namespace lambent::scene
