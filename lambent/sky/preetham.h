// The sky and the Sun of preetham1999practical: luminance, colour and spectra of a clear to hazy
// sky by one number, turbidity.
#pragma once

#include <span>
#include <vector>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/sun_frame.h"

namespace lambent::sky {

/// In the Sun's frame; below the horizon what stands at the horizon above.
struct PreethamSky {
  struct Part {
    Gradation gradation;
    Indicatrix indicatrix;
    double scale = 0;  ///< the zenith's value over F(0, θ_s)
    double at(const SkyAngles& angles) const;
  };
  Part luminancePart, xPart, yPart;
  Vec3d sun{0, 1, 0};

  double luminance(const Vec3d& direction) const;  ///< cd m⁻²
  /// Chromaticity x, y and luminance Y in cd m⁻².
  Vec3d xyY(const Vec3d& direction) const;
  /// With the scotopic luminance of daylight of that colour.
  radiometry::Xyzv color(const Vec3d& direction) const;
  /// W m⁻² sr⁻¹ nm⁻¹ at `nm`, by the daylight basis: never negative.
  std::vector<double> spectrum(const Vec3d& direction, std::span<const double> nm) const;
};

/// Turbidity counts as at least 2 and at most 10, the Sun below the horizon as on it, with its
/// light times twilightFactor(). The paper was fitted to simulations of T = 2 … 6 with the Sun
/// above the horizon.
PreethamSky preethamSky(double turbidity, double sunElevation);

struct ZenithColor {
  double luminance;  ///< cd m⁻², ≥ 0
  double x, y;
};
/// Appendix 2, without any clamp of its inputs: T of 2 … 10, θ_s of 0 … π/2.
ZenithColor preethamZenith(double turbidity, double sunZenith);

/// How much of the Sun's light reaches the ground, 0 … 1, at a wavelength of 300 … 800 nm (appendix
/// 1): Rayleigh, Ångström's aerosols, ozone, mixed gases, water vapour. Turbidity from 1 (no
/// aerosols). A Sun below the horizon counts as on it.
struct SunPath {
  double turbidity = 2;
  double ozone = .35;             ///< cm
  double precipitableWater = 2;   ///< cm
  double angstromExponent = 1.3;  ///< α
};
double preethamSunTransmittance(const SunPath& path, double sunElevation, double nm);

}  // namespace lambent::sky
