// Threads and yarns: tubes around a curve, as triangles.
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::meso {

enum class Winding { Kept, Turned };  ///< Turned: where the tube is laid out by a reflection

/// The unit normal of a tube by its places, point(s, angle), at s along it: by differences.
template <class Point>
Vec3d tubeNormal(const Point& point, double s, double angle) {
  const double h = 1e-5;
  const Vec3d along = point(s + h, angle) - point(s - h, angle);
  const Vec3d around = point(s, angle + h) - point(s, angle - h);
  return around.cross(along).normalized();
}

/// Appends a tube open at both ends: `rows` stretches long, `columns` facets around. vertex(row,
/// angle) is its place and its unit normal (a pair of Vec3d) for row 0 … rows and the angle in
/// [0, 2π); angles grow counter-clockwise seen against the way along it, unless it is Turned.
template <class Vertex>
void appendTube(scene::Mesh& mesh, int rows, int columns, const Vertex& vertex,
                Winding winding = Winding::Kept) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto [place, normal] = vertex(row, 2.0 * kPi * column / columns);
      mesh.positions.push_back(place.template cast<float>());
      mesh.normals.push_back(normal.template cast<float>());
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto a = first + static_cast<std::uint32_t>(row * columns + column);
      const auto b = first + static_cast<std::uint32_t>(row * columns + (column + 1) % columns);
      const std::uint32_t c = a + static_cast<std::uint32_t>(columns);
      const std::uint32_t d = b + static_cast<std::uint32_t>(columns);
      if (winding == Winding::Turned) {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      }
    }
}

}  // namespace lambent::meso
