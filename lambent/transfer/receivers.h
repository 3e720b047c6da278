// Where transfer is stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::transfer {

/// One at each vertex of the mesh, in its sequence.
struct AtVertices {};

/// One at each texel of a grid over the mesh's texel UVs (scene::texelUvsOf), row 0 at v = 0.
struct AtTexels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> covered;  ///< 1 where a surface point stands, 0 dilated or empty
};

struct Receivers {
  std::vector<Vec3> positions, normals;  ///< world space, one of each for every receiver
  std::variant<AtVertices, AtTexels> where;

  std::size_t size() const { return positions.size(); }
  /// The grid, if they stand on one.
  const AtTexels* texels() const { return std::get_if<AtTexels>(&where); }
};

/// A field as simulated, the same encoded, and what is shown of it stand on the same receivers.
using SharedReceivers = std::shared_ptr<const Receivers>;

}  // namespace lambent::transfer
