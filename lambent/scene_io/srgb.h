// Colours that files keep as sRGB code values.
#pragma once

#include <cmath>

#include "lambent/math/types.h"

namespace lambent::scene_io {

/// IEC 61966-2-1, code value in [0, 1] → linear.
inline float linearFromSrgb(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}
inline Rgb linearFromSrgb(const Rgb& c) {
  return {linearFromSrgb(c.x()), linearFromSrgb(c.y()), linearFromSrgb(c.z())};
}

}  // namespace lambent::scene_io
