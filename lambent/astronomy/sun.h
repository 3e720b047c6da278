// The Sun: where it stands, how far it is, how large it looks.
//
// This work is based on:
// - jensen2001physically, appendix, "Sun": its longitude and distance by two terms of the equation
//   of the centre.
// - ERFA's eraEpv00 (the Earth by VSOP2000, some kilometres over 1900-2100), with light time,
//   aberration, nutation and parallax (observer.h).
// - prsa2016nominal: the nominal radius of the Sun.
//
// Measured (sun_test.cpp): the former is within 1.03′ of the latter at 6 000 random moments and
// places of 1900-2100, and within 1.04′ over 1600-2400.
#pragma once

#include "lambent/astronomy/horizontal.h"
#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"

namespace lambent::astronomy {

inline constexpr double kAstronomicalUnit = 149597870700.0;  ///< m, IAU 2012 resolution B2
inline constexpr double kSunRadius = 6.957e8;                ///< m, IAU 2015 resolution B3

/// By the appendix: 1.2′ over 1900-2100, for where a Sun is drawn at once. Geocentric: its parallax
/// (8.8″ at most), nutation and aberration are left out, as there.
Topocentric lowPrecisionSun(const Moment& moment, const Place& place);

/// By ERFA, as the observer sees it but for refraction: arc-seconds over 1900-2100, growing slowly
/// to either side. A moment's ut1MinusUtc counts here: 15″ a second.
Topocentric apparentSun(const Moment& moment, const Place& place);

/// Apparent place from the Earth's centre, true equator and equinox of date; the distance is the
/// light's way. By ERFA.
Equatorial geocentricSun(const JulianDate& tt);

/// Half the angle (rad) that the disc covers at a distance (m) beyond kSunRadius.
double sunAngularRadius(double distance);

/// What sunlight at a distance (m) is of that at one astronomical unit: .967 … 1.034 over a year.
double sunIrradianceScale(double distance);

}  // namespace lambent::astronomy
