// Meshes of which some triangles are wound the wrong way, as scans and CAD exports leave them: which
// those are, and turning them round.
#pragma once

#include <cstddef>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// What is believed of a part that hangs together with no other, all of whose triangles contradict
/// their normals and none of which contradicts its neighbours.
enum class LonePart {
  Normals,      ///< its triangles are reversed
  OutwardOnly,  ///< they are reversed if it is closed and its fronts are inside
};

/// Reverses triangles that contradict their own three normals (each lies behind the triangle, by
/// more than rounding) where their winding contradicts that of the triangles beside them too: patch
/// by patch, patches being of such triangles that agree with each other. A patch that goes on into
/// its surroundings without a break is left: there the normals are wrong, not the winding. Vertices
/// of equal position are one. One normal for each position. Returns how many were reversed. Linear
/// in the number of triangles.
std::size_t reverseAgainstNormals(Mesh& mesh, LonePart lone);

/// Reverses triangles so that neighbours across an edge of two triangles agree, part by part. A part
/// of which less than a quarter of the triangles would be reversed faces as the others do; one that
/// is more mixed faces outwards if it is closed. What has one side only (a Möbius strip) is left.
/// Vertices of equal position are one; normals are not looked at. Returns how many were reversed.
/// Linear in the number of triangles.
std::size_t reverseAgainstNeighbours(Mesh& mesh);

}  // namespace lambent::scene
