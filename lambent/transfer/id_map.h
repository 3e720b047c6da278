// The id map q(u): which place of the patch stands at a place of the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::transfer {

/// A grid over TEXCOORD_0, row 0 at v = 0 (as glTF's images lie). Every texel names a place of the
/// patch as a fraction of its period along x and y, in 16 bits each: q = id / 65536. The numbers
/// wrap around as the patch does.
struct IdMap {
  int width = 0, height = 0;
  std::vector<std::uint16_t> ids;  ///< [row][column][2]

  std::size_t texelCount() const { return std::size_t(width) * std::size_t(height); }
  Vec2 at(int x, int y) const {
    const std::size_t i = 2 * (std::size_t(y) * width + x);
    return Vec2(ids[i], ids[i + 1]) * 0x1p-16f;
  }
};

}  // namespace lambent::transfer
