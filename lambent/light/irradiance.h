// The irradiance map of nine coefficients (ramamoorthi2001efficient): irradiance as a quadratic
// polynomial in the normal, or as a 4×4 matrix. The sequence of harmonics is ours, which is the
// paper's.
//
// This work is based on:
// - ramamoorthi2001efficient: eq. 7-9 (convolution with the clamped cosine), 11-13.
#pragma once

#include <array>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

/// The constants of eq. 12, from Â_l (eq. 8) and the normalisations of y_lm (eq. 3).
struct IrradianceConstants {
  double c1;  ///< Â₂ · ¼√(15/π): 0.429043
  double c2;  ///< Â₁ · ½ · √(3/4π): 0.511663 (printed as 0.511664)
  double c3;  ///< Â₂ · ¾√(5/π): 0.743124 (printed as 0.743125)
  double c4;  ///< Â₀ · √(1/4π): 0.886227
  double c5;  ///< Â₂ · ¼√(5/π): 0.247708
};
const IrradianceConstants& irradianceConstants();

/// One symmetric matrix for each channel (eq. 12): E = nᵗ M n with n = (x, y, z, 1) (eq. 11).
struct IrradianceMap {
  std::array<Mat4, 3> matrix;

  /// Irradiance (W m⁻² per channel) on a surface with this unit normal. Within 3/32 of the light's
  /// total ∫ radiance ds of the exact value, for any light (§3.1: "9%"); exact for a light of 3
  /// bands. Can be slightly negative.
  Rgb evaluate(const Vec3& normal) const;
};

/// Uses the first three bands; missing ones count as 0.
IrradianceMap irradianceMap(const sh::RgbCoefficients& light);

/// The same value by the polynomial (eq. 13).
Rgb irradiance(const sh::RgbCoefficients& light, const Vec3& normal);

}  // namespace lambent::light
