// How an observer on the turning Earth stands and moves in the celestial frame, by the models of the
// IAU: precession-nutation of 2006/2000A, sidereal time with the equation of the equinoxes, WGS 84.
// ERFA does the work: eraPnm06a, eraGst06, eraPvtob. The motion of the pole (0.3″) is left out.
#pragma once

#include "lambent/astronomy/horizontal.h"
#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"

namespace lambent::astronomy {

/// True equator and equinox of date from the celestial frame (GCRS), terrestrial time.
Mat3d trueFromCelestial(const JulianDate& tt);

struct Observer {
  Vec3d position = Vec3d::Zero();  ///< m from the Earth's centre, celestial frame (GCRS)
  Vec3d velocity = Vec3d::Zero();  ///< m/s against it
  Mat3d worldFromCelestial = Mat3d::Identity();
};

Observer observerAt(const Moment& moment, const Place& place);

/// Where light from a direction seems to come from for who moves at a velocity (m/s): special
/// relativity, unit vectors in and out (eraAb, with the Sun's pull at 1 au).
Vec3d aberrated(const Vec3d& direction, const Vec3d& velocity);

/// Spherical coordinates of a vector (m) of the true frame of date.
Equatorial equatorialOf(const Vec3d& vector);

}  // namespace lambent::astronomy
