// How much of the Sun's disc stands above a horizon.
#pragma once

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"

namespace lambent::sky {

/// Of the Sun at 1 AU, rad.
inline constexpr double kSunRadius = 0.004652;

/// The part of a disc above a straight edge; `height`: its centre's above the edge, in radii.
inline double discAbove(double height) {
  const double x = std::clamp(height, -1.0, 1.0);
  return 1 - (std::acos(x) - x * std::sqrt(1 - x * x)) / kPi;
}

/// Irradiance of a horizontal surface by a disc of irradiance 1 that has its centre at an elevation
/// above a flat horizon: ∫ of the sine of elevations ≥ 0 over the disc, without a step as it sets.
inline double horizontalShareOfDisc(double elevation) {
  const double x = std::clamp(elevation / kSunRadius, -1.0, 1.0);
  if (x >= 1) return std::sin(elevation);
  // (x discAbove(x) + ∫ of the disc's own heights) radii; the latter is 2/3π (1 − x²)^(3/2).
  const double rest = 1 - x * x;
  return kSunRadius * (x * discAbove(x) + 2 / (3 * kPi) * rest * std::sqrt(rest));
}

}  // namespace lambent::sky
