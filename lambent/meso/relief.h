// Height fields by formula.
#pragma once

#include <functional>

#include "lambent/meso/patch.h"

namespace lambent::meso {

struct Relief {
  double height;  ///< in periods along x
  Rgb color;      ///< diffuse reflectance
};

/// A relief over the unit square, sampled at the middles of resolution² cells (≥ 2 a side).
Patch relief(const char* name, const Vec2& size, int resolution,
             const std::function<Relief(double x, double y)>& at);

/// From a (t = 0) to b (t = 1).
inline Rgb mixed(const Rgb& a, const Rgb& b, double t) {
  return a + static_cast<float>(t) * (b - a);
}

}  // namespace lambent::meso
