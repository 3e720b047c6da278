// What one sees of a sky in a direction, its ground and its Sun included: what pictures, tables and
// answers about a single direction share.
#pragma once

#include <span>

#include "lambent/math/types.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/make_sky.h"

namespace lambent::sky {

/// What stands below the horizon.
enum class BelowHorizon {
  Dome,    ///< what the dome has there: of the simulations the ground behind the air before it
  Ground,  ///< Sky::ground everywhere, for models that know of nothing but the sky
  Black,
};

/// Dome for the simulations, Ground for all others.
BelowHorizon belowHorizonOf(Model model);

/// Without the Sun's disc. `direction`: unit, in the Sun's frame.
radiometry::Xyzv colorSeen(const Sky& sky, BelowHorizon below, const Vec3d& direction);
/// W m⁻² sr⁻¹ nm⁻¹ at `wavelengths` (nm, 340 … 740), into as many. Between the wavelengths of the sky
/// Sky::groundRadiance is linear.
void spectrumSeen(const Sky& sky, BelowHorizon below, const Vec3d& direction,
                  std::span<const double> wavelengths, std::span<double> radiance);

/// Linear between the entries, constant beyond: a spectrum of the sky (as Sky::groundRadiance or
/// SunDisc::spectralIrradiance, one value for each of Sky::wavelengths) at any wavelength.
double spectrumAt(const Sky& sky, std::span<const double> values, double nanometres);

/// Linear RGB, W m⁻² sr⁻¹, of a luminance of Y / 683.002. Of a colour outside of Rec. 709 it is the
/// nearest to it on the way to grey of the same luminance, so that no channel is negative.
Rgb radianceRgb(const radiometry::Xyzv& xyzv);
/// The same of linear RGB with any sign, of a luminance ≥ 0.
Rgb withinGamut(const Eigen::Array3d& rgb);

}  // namespace lambent::sky
