// Where a body stands above an observer's horizon.
#pragma once

#include <cmath>

#include "lambent/math/types.h"

namespace lambent::astronomy {

struct Horizontal {
  double azimuth = 0;    ///< rad, compass bearing: north 0, east π/2; [0, 2π)
  double elevation = 0;  ///< rad above the horizon, −π/2 … π/2
};

/// A body as an observer on the ground has it.
struct Topocentric {
  Horizontal direction;  ///< without refraction (refraction.h)
  double distance = 0;   ///< m from the observer
};

/// A body as it stands among the stars: right ascension [0, 2π) and declination, rad, in the true
/// equator and equinox of date, as seen from the Earth's centre.
struct Equatorial {
  double rightAscension = 0;
  double declination = 0;
  double distance = 0;  ///< m from the Earth's centre
};

/// The unit vector in the world: +y up, north −z, east +x.
inline Vec3d worldDirection(const Horizontal& direction) {
  const double level = std::cos(direction.elevation);
  return {level * std::sin(direction.azimuth), std::sin(direction.elevation),
          -level * std::cos(direction.azimuth)};
}

/// The inverse, of a vector of any length but 0. Straight up and down the azimuth is 0.
inline Horizontal horizontalOf(const Vec3d& world) {
  double azimuth = std::atan2(world.x(), -world.z());
  if (azimuth < 0) azimuth += 2 * kPi;
  if (azimuth >= 2 * kPi || (world.x() == 0 && world.z() == 0)) azimuth = 0;
  return {azimuth, std::atan2(world.y(), std::hypot(world.x(), world.z()))};
}

}  // namespace lambent::astronomy
