// The oriented surface with border that underlies any triangle mesh: who lies beside whom.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::synthesis {

/// In a table of numbers: no such vertex, half-edge or triangle.
inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Vertices of equal position are taken as one, and triangles hang together as scene::halfEdges has
/// it. Along every other edge, and at points where several
/// fans of triangles touch, the surface is cut; so each vertex of what is left has one fan of
/// triangles around it, whatever the mesh.
///
/// Half-edge 3t + k runs from corner k to corner k+1 of triangle t, and stands for corner k too.
/// Triangles with two corners at one place have no part in it (all their entries are kNone).
struct Manifold {
  std::vector<std::uint32_t> vertexOfCorner;  ///< 3 per triangle of the mesh
  std::vector<std::uint32_t> twin;  ///< the half-edge that runs the other way, or kNone at a border
  /// The first corner of each vertex's fan, counter-clockwise; at a border that which has no
  /// triangle before it.
  std::vector<std::uint32_t> firstCorner;
  std::vector<std::uint32_t> componentOfVertex;
  std::uint32_t components = 0;

  std::size_t degenerateTriangles = 0;  ///< with two corners at one place
  std::size_t borderEdges = 0;          ///< of one triangle
  std::size_t nonManifoldEdges = 0;     ///< of three triangles or more: cut
  std::size_t inconsistentEdges = 0;    ///< of two triangles wound against each other: cut

  std::size_t vertexCount() const { return firstCorner.size(); }
  std::uint32_t componentOfTriangle(std::uint32_t t) const {
    const std::uint32_t v = vertexOfCorner[3 * t];
    return v == kNone ? kNone : componentOfVertex[v];
  }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// The corner that follows counter-clockwise (or clockwise) in the same fan; kNone at a border.
  std::uint32_t turnLeft(std::uint32_t corner) const { return twin[previous(corner)]; }
  std::uint32_t turnRight(std::uint32_t corner) const {
    const std::uint32_t t = twin[corner];
    return t == kNone ? kNone : next(t);
  }
};

/// A mesh's indices must lie within its positions.
Manifold manifoldOf(const scene::Mesh& mesh);

}  // namespace lambent::synthesis
