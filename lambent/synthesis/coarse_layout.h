// Where on the patch synthesis begins: one layout over the surface, as even as its field lets it.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/synthesis/meso_graph.h"

namespace lambent::synthesis {

/// The place of the patch at each vertex of a level, not wrapped.
std::vector<Vec2> coarseLayout(const MesoGraph& graph, std::uint64_t seed);

}  // namespace lambent::synthesis
