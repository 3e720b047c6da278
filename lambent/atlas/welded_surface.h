// A mesh as a surface: vertices of equal position are one, and triangles know their neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::atlas {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

struct WeldedSurface {
  std::vector<Vec3d> positions;  ///< distinct ones
  /// Three positions for each triangle of the mesh, in its sequence.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// The triangle on the other side of edge k → k+1, or kNoTriangle at borders, which are also
  /// where more than two triangles meet or two are wound against each other.
  std::vector<std::array<std::uint32_t, 3>> neighbours;
  std::vector<Vec3d> normals;    ///< unit; zero for triangles without area
  std::vector<Vec3d> centroids;  ///< metres
  std::vector<double> areas;     ///< m²; 0 for triangles that are too thin to lay out
  double area = 0.0;             ///< of all
  std::size_t nonManifoldEdges = 0;

  bool hasArea(std::uint32_t triangle) const { return areas[triangle] > 0.0; }
};

WeldedSurface weldedSurface(const scene::Mesh& mesh);

}  // namespace lambent::atlas
