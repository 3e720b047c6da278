// A mesh seen from its texture: which place of the surface each texel of a grid over its texel UVs
// (texelUvsOf) shows, and, for texels that show none, the nearest that does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

inline constexpr std::uint32_t kNobody = 0xffffffffu;

/// visit(x, y, u, v) for every texel of a width×height grid whose centre a triangle holds, its
/// border included; there the corners weigh (1−u−v, u, v), as doubles. The one rule of what a texel
/// shows: a centre on an edge is held by both triangles that share it. Triangles without area in
/// the square hold none. `mesh` has UVs; what lies outside of the unit square is not seen.
template <class Visit>
void visitTexels(const Mesh& mesh, const Triangle& triangle, int width, int height,
                 const Visit& visit) {
  using Point = Vec2d;
  const auto cross = [](const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); };
  Point p[3];
  for (int k = 0; k < 3; ++k) {
    const Vec2& uv = texelUvsOf(mesh)[triangle[k]];
    p[k] = Point(double(uv.x()) * width - 0.5, double(uv.y()) * height - 0.5);
  }
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0.0 || !std::isfinite(area)) return;
  const auto first = [&](int axis) {
    const double low = std::min({p[0][axis], p[1][axis], p[2][axis]});
    return static_cast<int>(std::ceil(std::max(low - 1e-6, 0.0)));
  };
  const auto last = [&](int axis, int count) {
    const double high = std::max({p[0][axis], p[1][axis], p[2][axis]});
    return static_cast<int>(std::floor(std::min(high + 1e-6, count - 1.0)));
  };
  const int x0 = first(0), x1 = last(0, width), y0 = first(1), y1 = last(1, height);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Point at(x, y);
      const double u = cross(at - p[0], p[2] - p[0]) / area;
      const double v = cross(p[1] - p[0], at - p[0]) / area;
      if (!(u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9)) visit(x, y, u, v);
    }
}

/// Texel (x, y) is entry y·width + x; its centre is at ((x + ½)/width, (y + ½)/height).
struct TexelMap {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangle;  ///< that holds the texel's centre, or kNobody
  std::vector<Vec2> barycentric;  ///< (u, v) of the centre, corners weighing (1−u−v, u, v); zero
                                  ///< where there is none

  std::size_t size() const { return triangle.size(); }
  bool covered(std::size_t texel) const { return triangle[texel] != kNobody; }
};

/// Of several triangles that hold a centre (visitTexels) the first has it.
TexelMap texelMap(const Mesh& mesh, int width, int height);

/// For every texel the nearest one for which `full` is not 0, by distance between centres, exactly
/// (of several as near one of them, always the same). kNobody everywhere if none is full.
std::vector<std::uint32_t> nearestFull(int width, int height, std::span<const std::uint8_t> full);

}  // namespace lambent::scene
