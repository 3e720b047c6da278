// The pieces of a surface between receivers, in which it is interpolated: triangles, or cells of
// four texels. Here: those that have a chosen corner, and places in them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lambent/transport/receivers.h"

namespace lambent::transport {

/// A place of a surface, and of which receivers it is interpolated.
struct PlaceInPiece {
  std::uint32_t triangle;
  float u, v;                                            ///< barycentric, in the triangle
  std::vector<std::pair<std::uint32_t, float>> weights;  ///< receiver, w > 0; each once; Σ w = 1
};

/// Of every piece of a mesh that has a chosen receiver at a corner: places evenly over it, 36 in a
/// triangle, up to 16 in a cell. `chosen`: one for each receiver. Pieces and places in a sequence
/// that depends on nothing else.
std::vector<std::vector<PlaceInPiece>> piecesAt(const scene::Mesh& mesh,
                                                const PlacedReceivers::PerMesh& place,
                                                std::span<const std::uint8_t> chosen);

}  // namespace lambent::transport
