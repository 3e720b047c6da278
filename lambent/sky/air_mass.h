// Relative optical air mass: how much more air a slanted path crosses than a vertical one.
//
// This work is based on kasten1965new, which is the relative optical length of preetham2003modeling
// and of preetham1999practical, and on kasten1989revised. Both hold for molecules, never for
// aerosols, whose layer is thinner: at the horizon molecules have 36.5 or 37.9 (refraction
// included), aerosols of scale height 1.2 km some 91.
// Deviation: a path below the horizon counts as horizontal.
#pragma once

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"

namespace lambent::sky {

/// 1 / (cos θ + .15 (93.885 − θ)^−1.253), θ the zenith angle in degrees; the argument is the
/// elevation in radians. 1 … 36.5; .9995 in the zenith.
inline double kastenAirMass(double elevation) {
  const double height = std::clamp(elevation, 0.0, kPi / 2);
  return 1 / (std::sin(height) + .15 * std::pow(height * 180 / kPi + 3.885, -1.253));
}

/// 1 / (sin h + .50572 (h + 6.07995)^−1.6364), h in degrees: the revised table. 1 … 37.9.
inline double kastenYoungAirMass(double elevation) {
  const double height = std::clamp(elevation, 0.0, kPi / 2);
  return 1 / (std::sin(height) + .50572 * std::pow(height * 180 / kPi + 6.07995, -1.6364));
}

}  // namespace lambent::sky
