// Curves that generated patches are drawn with.
#pragma once

#include <algorithm>
#include <cmath>

namespace lambent::meso {

/// From 0 at `low` and below to 1 at `high` and above, with no slope at either.
inline double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The signed distance from x to the nearest whole number.
inline double fromWhole(double x) {
  return x - std::round(x);
}

}  // namespace lambent::meso
