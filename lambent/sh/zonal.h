// Functions that are symmetric about an axis: lobes, discs, hemispheres, phase functions. A zonal
// function h(cos θ) is kept as its Legendre moments ĥ_l = 2π ∫ h(t) P_l(t) dt, l = 0 … n−1, which
// are what convolution multiplies by: (h * f)_lm = ĥ_l f_lm. They relate to the projection
// coefficients h_l0 (sloan2002precomputed eq. 6) by ĥ_l = √(4π/(2l+1)) h_l0; ĥ_l is
// the Â_l of ramamoorthi2001efficient (eq. 6) and the product α_l G_l of sloan2002precomputed.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::sh {

using ZonalMoments = std::vector<double>;  ///< ĥ_l for l = 0 … n−1

ZonalMoments clampedCosine(int bands);  ///< max(cos θ, 0): π, 2π/3, π/4, 0, −π/24, …
ZonalMoments hemisphere(int bands);     ///< 1 for cos θ > 0
ZonalMoments cap(int bands, double halfAngle);       ///< 1 within halfAngle (radians) of the axis
ZonalMoments phongLobe(int bands, double exponent);  ///< (r+1)/2π·max(0,cos θ)^r, unit integral
ZonalMoments henyeyGreenstein(int bands, double g);  ///< unit integral: moments g^l
ZonalMoments delta(int bands);                       ///< unit integral at θ = 0: all ones
/// The sharpest function of n bands, n ≥ 1, that is nowhere negative: unit integral, largest ĥ_1.
/// What is convolved with it, and was not negative, is not cut to n bands either: it does not ring.
ZonalMoments sharpestNonNegative(int bands);
ZonalMoments zonal(int bands, const std::function<double(double cosTheta)>& h);  ///< by quadrature

/// Projection coefficients of the zonal function turned to point along a unit `axis`:
/// f_lm = ĥ_l y_lm(axis).
void turnTo(const ZonalMoments& moments, const Vec3d& axis, std::span<double> out);
void turnTo(const ZonalMoments& moments, const Vec3& axis, std::span<float> out);

/// (h * f)_lm = ĥ_l f_lm, in place; f has as many bands as moments or fewer.
void convolve(const ZonalMoments& moments, std::span<float> f);

}  // namespace lambent::sh
