// Edges of a scene, and triangles cut in two at them without a crack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// The edges of a scene, where vertices of equal position are one, whatever their normals, UVs or
/// meshes. Edge k of a triangle goes from its corner k to the next one.
struct SceneEdges {
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< from a position to itself

  std::vector<std::vector<std::array<std::uint32_t, 3>>> ofTriangle;  ///< [mesh][triangle]
  std::vector<float> lengths;                                         ///< metres
  /// Triangles at an edge, one after the other: those of edge e are users[firstUser[e]] and on, up
  /// to users[firstUser[e + 1]].
  struct User {
    std::uint32_t mesh, triangle;
  };
  std::vector<std::uint32_t> firstUser;
  std::vector<User> users;

  std::size_t size() const { return lengths.size(); }
  std::span<const User> usersOf(std::uint32_t edge) const {
    return {users.data() + firstUser[edge], users.data() + firstUser[edge + 1]};
  }
  /// The longest edge of a triangle, 0 … 2 (of equally long ones always the same, seen from any
  /// triangle); −1 if its corners are one position.
  int longestOf(std::uint32_t mesh, std::uint32_t triangle) const;
};
SceneEdges edgesOf(const Scene& scene);

/// Marks (1: to be cut) for every edge. A triangle that is cut at all is cut at its longest edge
/// (rivara1984algorithms): this adds the marks for that, through the neighbours, so that no angle
/// ever becomes smaller than half of the smallest of the first mesh.
void closeMarks(const SceneEdges& edges, std::vector<std::uint8_t>& marks);

/// How many vertices cutting at closed marks adds.
std::size_t addedVertices(const Scene& scene, const SceneEdges& edges,
                          std::span<const std::uint8_t> marks);

/// A vertex that was not there before: the middle between two of its mesh.
struct MiddleVertex {
  std::uint32_t a, b;
};

struct SplitScene {
  Scene scene;
  std::vector<std::vector<std::uint32_t>> parentOf;  ///< [mesh][triangle] → triangle before
  std::vector<std::vector<MiddleVertex>> middles;    ///< [mesh], in the sequence of new vertices
};

/// Cuts all edges that are marked in their middle, each triangle into two, three or four. Vertices
/// keep their numbers and new ones follow; colours and UVs are interpolated, normals too and made
/// unit. What shares an edge has its new vertex at the same place to the last bit; what shared
/// vertices shares the new ones. Materials, winding and what is at rest stay as they are. `marks`
/// must be closed. Backs (scene/sheets.h) stay the backs of their fronts.
SplitScene splitEdges(const Scene& scene, const SceneEdges& edges,
                      std::span<const std::uint8_t> marks);

/// Cuts the edges of `meshes` in their middles until none is longer than `longest` metres, or one
/// more round would add more than `budget` vertices in all. Returns how many were added; other
/// meshes are cut only where they share an edge.
std::size_t splitLongEdges(Scene& scene, std::span<const std::uint32_t> meshes, float longest,
                           std::size_t budget);

}  // namespace lambent::scene
