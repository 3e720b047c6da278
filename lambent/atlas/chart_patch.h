// One chart as a mesh of its own, cut open along its border, and whether it is a disc.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/atlas/charts.h"

namespace lambent::atlas {

struct ChartPatch {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> weldedVertex;  ///< of the surface; not for vertices inside holes
  /// The chart's, in its sequence, and then those that close its small holes.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t chartTriangles = 0;
  /// Borders before holes are closed, the longest first; each winds with the surface on its left.
  std::vector<std::vector<std::uint32_t>> loops;
  bool disc = false;  ///< of disc topology, with its holes closed

  std::size_t chartVertices() const { return weldedVertex.size(); }
};

/// Vertices that the border meets more than once are doubled there. `chartOf` tells for every
/// triangle of the surface which chart it is in. `numberOf` has an entry for each triangle of the
/// surface, of which those of this chart are written.
ChartPatch chartPatch(const WeldedSurface& surface, const Chart& chart,
                      const std::vector<std::uint32_t>& chartOf,
                      std::vector<std::uint32_t>& numberOf);

}  // namespace lambent::atlas
