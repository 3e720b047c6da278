// From spectra of air to linear RGB, of few wavelengths.
#pragma once

#include <span>

#include "lambent/math/types.h"
#include "lambent/sky/scattering.h"

namespace lambent::sky {

/// What makes colours of what a Scattering answers. Its spectra, of light relative to the Sun's above
/// the air and of transmittance, are smooth: between wavelengths they are cubic, while the Sun's own
/// spectrum and the eye's functions are integrated every nm. 16 wavelengths over 380-740 nm then do
/// (aerial_perspective_test.cpp holds them to 73).
class AirColors {
 public:
  /// The atmosphere is asked for the Sun's spectrum, as mediumOf() does. sunDistance: in AU.
  AirColors(const Scattering& scattering, const Atmosphere& atmosphere, double sunElevation,
            double sunDistance = 1);

  /// Linear RGB, W m⁻² sr⁻¹ (see radiometry::linearRgbOf), of radiances for the Sun's irradiance
  /// above the air of 1. A colour outside of Rec. 709 has a negative component.
  Eigen::Array3d radiance(std::span<const double> relative) const;

  /// 1 − f by channel, for optical thicknesses: what is lost of the colour of a white surface on the
  /// ground, in the light that the ground has under this Sun. Primaries overlap with negative weights
  /// here and there, so a channel is held between the wavelength that loses least and the one that
  /// loses most; f is in [0, 1], and of a grey surface it is exact.
  Eigen::Array3d lost(std::span<const double> opticalThickness) const;

 private:
  Eigen::Matrix3Xd radiance_, white_;  ///< [channel][wavelength]; rows of white_ sum to 1
};

}  // namespace lambent::sky
