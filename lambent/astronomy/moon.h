// The Moon: where it stands, how far it is, how it is lit.
//
// This work is based on:
// - jensen2001physically, appendix, "Moon" and "Rotation and Phase of the Moon".
// - ERFA's eraMoon98 (meeus1998astronomical, chapter 47: ELP 2000-82 abridged; 3″ rms, 18″ at most
//   against a numerical integration over 1950-2100), with light time, nutation and parallax.
//
// Measured (moon_test.cpp): the former is within 6.6′ of the latter, and its distance within .2%, at
// 6 000 random moments and places of 1900-2100.
#pragma once

#include "lambent/astronomy/horizontal.h"
#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"

namespace lambent::astronomy {

inline constexpr double kMoonRadius = 1737400.0;   ///< m, mean
inline constexpr double kEarthRadius = 6378137.0;  ///< m, equatorial: the appendix's unit of length

/// By the appendix: 8′ over 1900-2100, from a round Earth.
Topocentric lowPrecisionMoon(const Moment& moment, const Place& place);

/// By ERFA, as the observer sees it but for refraction: arc-seconds.
Topocentric apparentMoon(const Moment& moment, const Place& place);

/// Apparent place from the Earth's centre, true equator and equinox of date. By ERFA.
Equatorial geocentricMoon(const JulianDate& tt);

/// Half the angle (rad) that the disc covers at a distance (m) beyond kMoonRadius.
double moonAngularRadius(double distance);

/// The angle at the Moon between Sun and observer, 0 (full) … π (new), rad.
double phaseAngle(const Topocentric& sun, const Topocentric& moon);

/// The part of the disc's area that sunlight reaches: (1 + cos phase)/2.
double illuminatedFraction(double phaseAngle);

/// The unit vector of the world from the Moon's centre to the middle of the terminator that the
/// observer sees, (s − m) × (s × m); there the Sun's vector s is its own distance long (the
/// appendix's "d_Moon times 23455" means the Sun's r). 0 where Sun, Moon and observer stand in one line.
Vec3d terminatorDirection(const Topocentric& sun, const Topocentric& moon);

}  // namespace lambent::astronomy
