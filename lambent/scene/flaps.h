// Flaps: pairs of triangles that lie back to back on a surface, as programs leave them that make a
// mesh of scans. They enclose nothing and hide nothing, but at their edges four triangles meet.
#pragma once

#include <cstddef>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// Takes out what is a flap: one pair of triangles on the same three places, wound against each
/// other, or two such pairs side by side, that hang on an edge where the surface goes on without
/// them. Larger sheets back to back, and those that hang on nothing, are somebody's leaves and stay.
/// Vertices that nothing else has go with them. Returns how many pairs there were.
std::size_t dropFlaps(Mesh& mesh);

}  // namespace lambent::scene
