// The analytic models as skies: dome, Sun and ground from one set of options.
#pragma once

#include "lambent/sky/dome.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/perez.h"

namespace lambent::sky {

/// Turbidity as analytic skies take it: the atmosphere's own; else the one whose aerosols have the
/// atmosphere's optical thickness at 1 µm (preetham1999practical, appendix 1), at least 1.
double turbidityOf(const Atmosphere& atmosphere);

/// What a weather station would measure under a clear sky of Linke turbidity T, W m⁻²: the
/// clear-sky model of rigollier2000clear. A Sun below the horizon counts as on it, with both
/// irradiances times twilightFactor(): so the sky's clearness goes on as it was, and
/// SunDisc::visible takes the disc away.
MeasuredIrradiance clearSkyIrradiance(double linkeTurbidity, double sunElevation,
                                      double sunDistance = 1);

/// A sky of any model but Exact and Fast, which assert. Of the atmosphere turbidity, ozone, ground
/// albedo and solar irradiance count.
///
/// The Sun's light is that of preetham1999practical, and none under an overcast sky, under types 1
/// … 6 of the general sky and under type 9 (an obscured Sun). Perez and ASRC-CIE scale it to the
/// direct illuminance of what was measured. Their colours and those of the CIE's are daylight of
/// 6500 K.
Sky analyticSky(const SkyOptions& options);

}  // namespace lambent::sky
