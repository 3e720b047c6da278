// Which edges of triangles lie against each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// Half-edge 3t + k runs from corner k to corner k+1 of triangle t.
struct HalfEdges {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<std::uint32_t> twin;    ///< the one that runs the other way, or kNone
  std::size_t borderEdges = 0;        ///< of one triangle
  std::size_t nonManifoldEdges = 0;   ///< of three triangles or more: cut
  std::size_t inconsistentEdges = 0;  ///< of two triangles wound against each other: cut
};

/// Of triangles whose corners are numbers of places; those that are `leftOut` ([triangle], 1) have no
/// part in it. Triangles hang together over edges that two of them share, wound alike; and over
/// those of two sheets back to back, each side in itself.
HalfEdges halfEdges(std::span<const Triangle> triangles, std::span<const std::uint8_t> leftOut);

}  // namespace lambent::scene
