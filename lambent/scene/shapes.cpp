#include "lambent/scene/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace lambent::scene {
namespace {

struct Vertex {
  Vec3 position, normal;
};

/// A grid of (columns+1)×(rows+1) vertices from a formula over (u, v) in [0, 1]², appended to
/// `mesh`. The front is where ∂/∂v × ∂/∂u points. A first or last row that is a pole has one vertex
/// for each column, with u in the middle of it, and one triangle instead of two.
struct Grid {
  int columns, rows;
  bool poleFirst = false, poleLast = false;
  Vec2 uvLower = Vec2(0, 0), uvUpper = Vec2(1, 1);
};

void appendGrid(Mesh& mesh, const Grid& grid, const std::function<Vertex(double, double)>& f) {
  std::vector<std::uint32_t> starts;
  for (int row = 0; row <= grid.rows; ++row) {
    const bool pole = (grid.poleFirst && row == 0) || (grid.poleLast && row == grid.rows);
    starts.push_back(std::uint32_t(mesh.positions.size()));
    for (int column = 0; column < grid.columns + (pole ? 0 : 1); ++column) {
      const double u = (column + (pole ? 0.5 : 0.0)) / grid.columns, v = double(row) / grid.rows;
      const Vertex vertex = f(u, v);
      mesh.positions.push_back(vertex.position);
      mesh.normals.push_back(vertex.normal);
      const Vec2 t = Vec2(float(u), float(v));
      mesh.uvs.push_back(grid.uvLower + t.cwiseProduct(grid.uvUpper - grid.uvLower));
    }
  }
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::uint32_t a = starts[row] + column, b = a + 1;
      const std::uint32_t c = starts[row + 1] + column, d = c + 1;
      if (grid.poleFirst && row == 0) {
        mesh.triangles.push_back({a, c, d});
      } else if (grid.poleLast && row == grid.rows - 1) {
        mesh.triangles.push_back({a, c, b});
      } else {
        mesh.triangles.push_back({a, c, d});
        mesh.triangles.push_back({a, d, b});
      }
    }
  }
}

/// cos and sin of u turns, with the seam's two ends and the axes bitwise equal, so that welding by
/// position closes it.
struct Turn {
  double cos, sin;
};
Turn turn(double u) {
  if (u >= 1.0) u = 0.0;
  const double angle = 2.0 * kPi * u;
  return {std::cos(angle), std::sin(angle)};
}

Vec3 vec(double x, double y, double z) {
  return Vec3(float(x), float(y), float(z));
}

/// A band of a surface of revolution about +Y, front outwards for a profile that runs downwards.
void appendRevolution(Mesh& mesh, const Grid& grid, double r0, double y0, double r1, double y1,
                      const Vec2& normal) {
  appendGrid(mesh, grid, [&](double u, double v) {
    const Turn t = turn(u);
    const double r = r0 + v * (r1 - r0), y = y0 + v * (y1 - y0);
    return Vertex{vec(r * t.cos, y, -r * t.sin),
                  vec(normal.x() * t.cos, normal.y(), -normal.x() * t.sin)};
  });
}

}  // namespace

Mesh uvSphere(float radius, int slices, int stacks) {
  assert(slices >= 3 && stacks >= 2);
  Mesh mesh;
  mesh.name = "sphere";
  appendGrid(mesh, {slices, stacks, true, true}, [&](double u, double v) {
    const Turn t = turn(u);
    const double s = v <= 0.0 || v >= 1.0 ? 0.0 : std::sin(kPi * v), c = std::cos(kPi * v);
    const Vec3 n = vec(s * t.cos, c, -s * t.sin);
    return Vertex{radius * n, n};
  });
  return mesh;
}

Mesh icosphere(float radius, int subdivisions) {
  assert(subdivisions >= 0 && subdivisions <= 10);
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                               {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                               {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3d& p : points) p.normalize();
  Mesh mesh;
  mesh.name = "icosphere";
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [entry, isNew] =
          middles.try_emplace(std::minmax(i, j), std::uint32_t(points.size()));
      if (isNew) points.push_back((points[i] + points[j]).normalized());
      return entry->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (const Vec3d& p : points) {
    mesh.normals.push_back(p.cast<float>());
    mesh.positions.push_back((double(radius) * p).cast<float>());
  }
  return mesh;
}

Mesh bowl(float radius, float areaFraction, int slices, int stacks) {
  assert(slices >= 3 && stacks >= 1 && areaFraction > 0.0f && areaFraction <= 1.0f);
  // A cap of half-angle θ has the fraction (1 − cos θ)/2 of the sphere's area.
  const double rim = std::acos(std::clamp(1.0 - 2.0 * double(areaFraction), -1.0, 1.0));
  const bool whole = areaFraction >= 1.0f;
  Mesh mesh;
  mesh.name = "bowl";
  appendGrid(mesh, {slices, stacks, true, whole}, [&](double u, double v) {
    const Turn t = turn(u);
    const double angle = rim * v;
    const double s = v <= 0.0 || (whole && v >= 1.0) ? 0.0 : std::sin(angle);
    const Vec3 n = vec(s * t.cos, -std::cos(angle), -s * t.sin);
    return Vertex{radius * n, -n};
  });
  return mesh;
}

Mesh gridPlane(float sizeX, float sizeZ, int quadsX, int quadsZ) {
  assert(quadsX >= 1 && quadsZ >= 1);
  Mesh mesh;
  mesh.name = "plane";
  appendGrid(mesh, {quadsX, quadsZ}, [&](double u, double v) {
    return Vertex{vec((u - 0.5) * sizeX, 0.0, (v - 0.5) * sizeZ), Vec3::UnitY()};
  });
  return mesh;
}

Mesh box(const Vec3& size, int quads) {
  assert(quads >= 1);
  // Per face: the normal n, and the directions of u and v with v × u = n.
  struct Face {
    Vec3 u, v;
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Face faces[6] = {{-z, -y}, {z, -y}, {x, z}, {x, -z}, {x, -y}, {-x, -y}};
  Mesh mesh;
  mesh.name = "box";
  for (int f = 0; f < 6; ++f) {
    const Face& face = faces[f];
    const Vec3 normal = face.v.cross(face.u);
    // A gap between the atlas's cells keeps bilinear filters and dilation apart.
    const Vec2 cell(1.0f / 3.0f, 0.5f), corner(float(f % 3) / 3.0f, float(f / 3) / 2.0f);
    Grid grid{quads, quads};
    grid.uvLower = corner + 0.03f * cell;
    grid.uvUpper = corner + 0.97f * cell;
    appendGrid(mesh, grid, [&](double u, double v) {
      const Vec3 p = 0.5f * normal + float(u - 0.5) * face.u + float(v - 0.5) * face.v;
      return Vertex{p.cwiseProduct(size), normal};
    });
  }
  return mesh;
}

Mesh room(const Vec3& size, int quads) {
  Mesh mesh = flipped(box(size, quads));
  mesh.name = "room";
  return mesh;
}

Mesh cylinder(float radius, float height, int segments, int rows) {
  assert(segments >= 3 && rows >= 1);
  Mesh mesh;
  mesh.name = "cylinder";
  const double h = 0.5 * height;
  Grid side{segments, rows}, top{segments, 1, true, false}, bottom{segments, 1, false, true};
  side.uvUpper.y() = 0.5f;
  top.uvLower.y() = 0.51f, top.uvUpper.y() = 0.75f;
  bottom.uvLower.y() = 0.76f;
  appendRevolution(mesh, side, radius, h, radius, -h, Vec2(1, 0));
  appendRevolution(mesh, top, 0, h, radius, h, Vec2(0, 1));
  appendRevolution(mesh, bottom, radius, -h, 0, -h, Vec2(0, -1));
  return mesh;
}

Mesh ring(float innerRadius, float outerRadius, float height, int segments, int rows) {
  assert(0.0f < innerRadius && innerRadius < outerRadius && segments >= 3 && rows >= 1);
  Mesh mesh;
  mesh.name = "ring";
  const double h = 0.5 * height, r = innerRadius, R = outerRadius;
  const auto band = [&](int count, float v0, float v1) {
    Grid grid{segments, count};
    grid.uvLower.y() = v0, grid.uvUpper.y() = v1;
    return grid;
  };
  appendRevolution(mesh, band(rows, 0.0f, 0.39f), R, h, R, -h, Vec2(1, 0));
  appendRevolution(mesh, band(1, 0.40f, 0.49f), R, -h, r, -h, Vec2(0, -1));
  appendRevolution(mesh, band(rows, 0.50f, 0.89f), r, -h, r, h, Vec2(-1, 0));
  appendRevolution(mesh, band(1, 0.90f, 1.0f), r, h, R, h, Vec2(0, 1));
  return mesh;
}

Mesh torus(float majorRadius, float minorRadius, int majorSegments, int minorSegments) {
  assert(majorSegments >= 3 && minorSegments >= 3);
  Mesh mesh;
  mesh.name = "torus";
  appendGrid(mesh, {majorSegments, minorSegments}, [&](double u, double v) {
    const Turn around = turn(u), across = turn(v);
    const double r = majorRadius + minorRadius * across.cos;
    return Vertex{vec(r * around.cos, -minorRadius * across.sin, -r * around.sin),
                  vec(across.cos * around.cos, -across.sin, -across.cos * around.sin)};
  });
  return mesh;
}

}  // namespace lambent::scene
