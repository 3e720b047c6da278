// Surfaces with two sides. A mesh is seen and lit from its front alone; one with two sides is a
// sheet that lies back to back with another: the same triangles once more, turned over, with
// vertices of their own. Both sides then hold transfer, and whoever culls back faces sees the right
// one. That a mesh is made so is a fact of its vertices and triangles, which files and transforms
// keep, and needs no mark.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// The mesh and behind its vertices and triangles those of its back: vertex v's is v + n, with the
/// normal turned over; that of triangle t = (a, b, c) is t + m = (a + n, c + n, b + n).
Mesh withBacks(Mesh mesh);

/// Whether the second half of a mesh's triangles is the back of its first half: the same turned over,
/// (a, b, c) as (a', c', b'), with vertices of their own at the same positions to the last bit.
bool hasBacks(const Mesh& mesh);

inline constexpr std::uint32_t kNoVertex = 0xffffffffu;
/// For every vertex the one of the other side, kNoVertex where no triangle has it. Empty: the mesh has
/// no backs.
std::vector<std::uint32_t> verticesOfOtherSide(const Mesh& mesh);

/// The triangle that lies on this one and faces the other way, of a mesh that has backs. The place
/// with the barycentric coordinates (u, v) here has (v, u) there.
std::uint32_t otherSideOf(const Mesh& mesh, std::uint32_t triangle);

/// Lays a mesh with backs out for texels: fronts in the left half of the unit square, backs in the
/// right one. Its texture coordinates are then of no use for a texture.
void layOutBacks(Mesh& mesh);

}  // namespace lambent::scene
