// A sky as a light: dome, Sun and ground as components of an Environment.
#pragma once

#include "lambent/light/environment.h"
#include "lambent/math/types.h"
#include "lambent/sky/dome.h"

namespace lambent::sky {

/// The dome above the horizon, the Sun's disc with its limb darkening as far as it stands above the
/// horizon, and the ground below it, of one radiance. W m⁻² sr⁻¹ of luminous equivalent per channel
/// (radianceRgb): 1 of each is 683.002 cd m⁻². worldFromSun turns the Sun's frame (dome.h) about +y.
light::Environment environmentOf(const Sky& sky, const Mat3d& worldFromSun);

/// u of the Sun's disc, whose radiance is that of its centre times 1 − u (1 − μ), for light of
/// 610, 550 and 465 nm: with the mean over the disc that limbDarkening() has.
Rgb solarLimbDarkening();

/// ∫ color y_i ds of a dome above a horizon (elevation, rad), X, Y and Z one after the other, each of
/// bands² numbers (1 … 10 bands): the dome's own, or by quadrature, right to 10⁻³ of the first.
std::vector<double> projectDome(const Dome& dome, double horizon, int bands);

}  // namespace lambent::sky
