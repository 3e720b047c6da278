// A patch that repeats itself, laid over a whole surface without a seam: an integer-grid map whose
// jumps are symmetries of the patch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/synthesis/cross_field.h"
#include "lambent/synthesis/patch_symmetry.h"

namespace lambent::synthesis {

struct LatticeMap {
  /// The place q of the patch at each corner of each triangle, a fraction of its period, not
  /// wrapped; over a triangle it is linear.
  std::vector<Vec2> places;    ///< 3 per triangle
  std::vector<Vec3> tangents;  ///< per triangle: where the patch's +x points, unit
  /// Edges over which the patch goes on: all but those at a whole-numbered singularity, where it
  /// cannot. To within 1e-3 of a period, by a translation or turn of the patch's symmetry.
  std::size_t edges = 0, continued = 0;
  double flipped = 0.0;  ///< share of the area where the patch lies face down
  double squeezed = 0.0;  ///< … where it is below 2/3 or above 3/2 of its size along some direction
  double stretch = 0.0;  ///< root mean square of ln(size), over area and directions
};

/// `field` as combed (its matching tells where the patch turns). The map is as rigid as the patch's
/// continuity allows (liu2008local), one whole number of lattice vectors around every loop.
/// `patchSize`: metres of the surface that the period covers. The same at any number of threads.
/// Failed where there is no memory for the system.
Result<LatticeMap> latticeMap(const Manifold& manifold, const CrossField& field,
                              std::span<const std::uint32_t> chartOfTriangle,
                              const PatchSymmetry& symmetry, const Vec2& patchSize,
                              const Progress& progress);

/// The patch's +x at each vertex of a mesh whose triangles are those of the map, and whose vertices
/// are doubled where the patch turns: unit, at right angles to the normal.
std::vector<Vec3> vertexTangents(const scene::Mesh& mesh, const LatticeMap& map);

}  // namespace lambent::synthesis
