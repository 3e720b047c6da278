// Which way a patch lies on each triangle, up to the turns that leave the patch as it is.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {

/// A field of `turns` equivalent directions on the triangles of a surface, unfolded from one to the
/// next. The plane of triangle t has axes x and y as complex numbers do; y lies to the left of x
/// for whoever looks along the mesh's normals from outside. Triangles that have no part in the
/// manifold hold nothing.
struct CrossField {
  int turns = 1;                                             ///< 1, 2 or 4
  std::vector<Vec3d> x, y;                                   ///< per triangle, unit
  std::vector<std::array<std::complex<double>, 3>> corners;  ///< per triangle, metres; 0 first
  std::vector<std::complex<double>> direction;               ///< per triangle: one of them, unit
  /// Per half-edge, quarter turns, 0 … 3: beyond it, in the triangle of its twin, the direction that
  /// continues this one's is that many quarter turns ahead of that triangle's own.
  std::vector<std::uint8_t> matching;
  struct Singularity {
    std::uint32_t vertex;  ///< of the manifold
    int index;             ///< in parts of `turns`: 1 of 4 is a quarter
  };
  std::vector<Singularity> singularities;  ///< inside; not where the surface ends
};

/// i^k
inline std::complex<double> quarterTurns(int k) {
  constexpr std::complex<double> kTurns[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return kTurns[k & 3];
}

/// `tangents`: one of the directions at each vertex of the mesh, as of tangentField. A border has
/// no singularities.
CrossField crossField(const scene::Mesh& mesh, const Manifold& manifold,
                      std::span<const Vec3> tangents, int turns);

/// The same field, with directions chosen so that they match across as many edges inside of each
/// chart as possible: all of a chart that is a disc without singularities inside.
void comb(const Manifold& manifold, std::span<const std::uint32_t> chartOfTriangle,
          CrossField& field);

}  // namespace lambent::synthesis
