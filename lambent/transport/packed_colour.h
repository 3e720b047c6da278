// A colour in four bytes, for what is kept by the million.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lambent/math/types.h"

namespace lambent::transport {

/// Linear RGB in [0, 1] as three times ten bits of its square roots: finer than the eight bits of
/// sRGB that a texture has, dark colours included. What is beyond is clamped.
inline std::uint32_t packColour(const Rgb& colour) {
  std::uint32_t packed = 0;
  for (int c = 0; c < 3; ++c) {
    const float root = std::sqrt(std::clamp(colour[c], 0.0f, 1.0f));
    packed |= static_cast<std::uint32_t>(root * 1023.0f + 0.5f) << (10 * c);
  }
  return packed;
}

inline Rgb unpackColour(std::uint32_t packed) {
  Rgb colour;
  for (int c = 0; c < 3; ++c) {
    const float root = static_cast<float>((packed >> (10 * c)) & 1023u) * (1.0f / 1023.0f);
    colour[c] = root * root;
  }
  return colour;
}

}  // namespace lambent::transport
