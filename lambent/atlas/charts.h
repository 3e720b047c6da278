// A surface cut into charts: compact pieces whose normals do not turn far, with borders along
// creases where there are any.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/atlas/welded_surface.h"

namespace lambent::atlas {

/// Triangles in rising sequence.
using Chart = std::vector<std::uint32_t>;

/// Every triangle of area in exactly one chart. A chart hangs together across edges; it need not be
/// a disc. The same at any number of threads.
std::vector<Chart> cutIntoCharts(const WeldedSurface& surface);

/// The chart in two or more pieces, for charts that cannot be laid out. `chart` has two triangles
/// at least. `chartOf` tells for every triangle of the surface which chart it is in.
std::vector<Chart> cutInTwo(const WeldedSurface& surface, const Chart& chart,
                            const std::vector<std::uint32_t>& chartOf);

/// The chart cut straight through a vertex of the surface that lies inside of it, where that takes
/// the shortest cut: pieces that hang together, of which none has the vertex inside. In two as
/// above where that fails.
std::vector<Chart> cutThrough(const WeldedSurface& surface, const Chart& chart,
                              const std::vector<std::uint32_t>& chartOf, std::uint32_t vertex);

}  // namespace lambent::atlas
