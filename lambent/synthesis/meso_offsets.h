// The way from a meso-vertex to each of its neighbours, measured in the patch.
#pragma once

#include <vector>

#include "lambent/synthesis/meso_mesh.h"

namespace lambent::synthesis {

/// For every neighbour in a level (parallel to Level::neighbours) where it lies, as a fraction of
/// the patch's period along x and y: the vector from the vertex, laid into the tangent planes of
/// both at its full length, and the mean of what the two frames see. Frames that are turned against
/// each other so share the turn, and the way back is the same with its sign changed.
std::vector<Vec2> offsetsOf(const MesoMesh& mesh, std::size_t level, const Vec2& patchSize);

}  // namespace lambent::synthesis
