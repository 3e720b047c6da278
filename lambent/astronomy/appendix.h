// Turns between the frames of the sky, by formulas that fit on a page.
//
// This work is based on: jensen2001physically, appendix, "Time Conversion" and "Coordinate
// Conversion". T is in Julian centuries since 2000 January 1, 12 h; angles in radians.
//
//   ecliptic     x to the equinox of date, z to the ecliptic's pole
//   equatorial   x to the equinox of date, z to the pole
//   world        +x east, +y up, +z south. The appendix's horizon frame has the same axes in another
//                sequence: x south, y east, z up.
//
// Checked against ERFA (sun_test.cpp): what it calls the matrix P is the precession of IAU 2006 to
// 3″ over a century.
#pragma once

#include "lambent/astronomy/place.h"
#include "lambent/math/types.h"

namespace lambent::astronomy::appendix {

/// The mean obliquity of the ecliptic: ε = 0.409093 − 0.000227 T, T in terrestrial time.
double obliquity(double centuries);

/// Equatorial of date from ecliptic of date: R_x(ε).
Mat3d equatorialFromEcliptic(double centuries);

/// Equatorial of date from equatorial of 2000: P = R_z(.01118 T) R_y(−.00972 T) R_z(.01118 T), as
/// catalogues of stars need it; the formulas for Sun and Moon contain precession.
Mat3d precession(double centuries);

/// The local mean sidereal time: LMST = 4.894961 + 230121.675315 T + lon, T in UT1 here.
double siderealTime(double centuriesUt1, double longitude);

/// World from equatorial of date: R_y(lat − π/2) R_z(−LMST), and the sequence of axes.
Mat3d worldFromEquatorial(double centuriesUt1, const Place& place);

}  // namespace lambent::astronomy::appendix
