// Tangent planes at the vertices of a surface, in which tangents are complex numbers whose arguments
// are angles scaled to 2π around a vertex (sharp2019vector §5.1).
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {

/// Per vertex of the manifold a plane with axes x and y, and per half-edge its angle in there.
struct TangentPlanes {
  std::vector<Vec3d> normal, x, y;
  std::vector<double> scale;   ///< of angles at the vertex: to 2π around an inner one
  std::vector<double> angle;   ///< per half-edge: scaled, at its tail
  std::vector<double> corner;  ///< per corner: its unscaled angle
  std::vector<double> mass;    ///< a third of the area around, as a share of the component's
  std::vector<double> area;    ///< per component, m²
  int turns = 1;               ///< equivalent directions: u is the power that all of them have

  /// The rotation ρ that carries a tangent, to the power of `turns`, along half-edge h.
  double transport(const Manifold& m, std::uint32_t h) const {
    return turns * (atHead(m, h) - atTail(h));
  }

  /// The scaled angle of half-edge h's way at its tail, and at its head.
  double atTail(std::uint32_t h) const { return angle[h]; }
  double atHead(const Manifold& m, std::uint32_t h) const {
    const std::uint32_t head = Manifold::next(h);
    return angle[head] + scale[m.vertexOfCorner[head]] * corner[head] + kPi;
  }
};

TangentPlanes tangentPlanes(const scene::Mesh& mesh, const Manifold& manifold, int turns);

}  // namespace lambent::synthesis
