// How far terrestrial time, in which planets move evenly, is ahead of the clock, which follows the
// Earth's rotation.
//
// This work is based on:
// - espenak2006five: the polynomials for ΔT = TT − UT1, years 1600 to 2400 of them.
// - ERFA's eraDat: TAI − UTC with its leap seconds, from 1960 on; TT = TAI + 32.184 s.
//
// Deviations: the year runs evenly instead of by months; after the last leap second that is known,
// the polynomial's distance from it (6.5 s in 2027) fades out over decades, so that nothing steps.
#pragma once

#include "lambent/astronomy/moment.h"

namespace lambent::astronomy {

/// ΔT = TT − UT1 in seconds at a decimal year, 1600 ≤ year ≤ 2401 (beyond, the outer polynomials go
/// on): within 1 s from 1800 to 2005, some 10 s before, a guess after (espenak2006five).
double polynomialDeltaT(double year);

/// TT − UTC in seconds. From 1960 to 2026 by leap seconds; before and after, where the clock is
/// taken to be UT1, by polynomialDeltaT.
double terrestrialMinusUtc(const Moment& moment);

}  // namespace lambent::astronomy
