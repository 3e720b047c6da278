// Private to this room: the texels between whose centres a look-up interpolates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "lambent/math/types.h"

namespace lambent::transport {

struct TexelTaps {
  std::array<std::uint32_t, 4> texels;
  std::array<double, 4> weights;
};

/// Of a place counted in texels from the centre of the first one; beyond the grid the last ones go
/// on.
inline TexelTaps tapsAt(double x, double y, int width, int height) {
  const double left = std::floor(x), top = std::floor(y), a = x - left, b = y - top;
  TexelTaps taps;
  for (int k = 0; k < 4; ++k) {
    const int i = std::clamp(static_cast<int>(left) + k % 2, 0, width - 1);
    const int j = std::clamp(static_cast<int>(top) + k / 2, 0, height - 1);
    taps.texels[k] = static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(width) +
                     static_cast<std::uint32_t>(i);
    taps.weights[k] = (k % 2 ? a : 1.0 - a) * (k / 2 ? b : 1.0 - b);
  }
  return taps;
}

/// … and of texture coordinates.
inline TexelTaps tapsAt(const Vec2& uv, int width, int height) {
  return tapsAt(double(uv.x()) * width - 0.5, double(uv.y()) * height - 0.5, width, height);
}

}  // namespace lambent::transport
