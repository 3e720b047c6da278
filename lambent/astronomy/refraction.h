// How far air lifts what shines through all of it.
//
// This work is based on:
// - saemundsson1986refraction: R = 1.02′ cot(h + 10.3/(h + 5.11)), h the true elevation in degrees,
//   in air of 283 K and 101 kPa; to .1′ of the inverse of bennett1982calculation.
// - meeus1998astronomical, chapter 16: the factor P/101 kPa · 283 K/T, and .0019279′ added, which
//   makes R vanish in the zenith.
//
// Deviation: the formula has a pole at h = −5.1°. Below −1° R goes on with the same value, slope and
// curvature as (a + b x + c x²) e^−x, x the degrees below −1°: it rises to 41′ near −1.6° and fades
// out, so that the apparent elevation is a smooth, rising function of the true one through dusk.
#pragma once

#include "lambent/astronomy/horizontal.h"
#include "lambent/report/result.h"

namespace lambent::astronomy {

/// The air where the observer stands.
struct Air {
  double temperature = 283;  ///< K
  double pressure = 101000;  ///< Pa; 0: no refraction
};

/// From degrees Celsius, −100 … 70, and hectopascals, 0 … 1200. BadUsage for others.
Result<Air> airFromCelsius(double celsius, double hectopascals);

/// The air of the U.S. Standard Atmosphere 1976 at an altitude in metres: its first two layers,
/// 288.15 K − 6.5 K/km up to 11 km, 216.65 K from there on.
Air standardAir(double altitude);

/// By how much (rad) a body outside of the air seems higher than its true elevation (rad,
/// −π/2 … π/2) tells. About 34.5′ for what seems to stand at the horizon, 1′ at 45°, 0 at 90°.
double refraction(double trueElevation, const Air& air = {});

/// The direction in which the body is seen.
Horizontal refracted(const Horizontal& trueDirection, const Air& air = {});

}  // namespace lambent::astronomy
