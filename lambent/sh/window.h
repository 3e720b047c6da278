// Windowing: attenuating the high bands against ringing.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lambent/sh/coefficients.h"
#include "lambent/sh/zonal.h"

namespace lambent::sh {

std::vector<double> hann(int bands, double width);     ///< (1+cos(πl/w))/2, 0 for l ≥ w
std::vector<double> lanczos(int bands, double width);  ///< sin(πl/w)/(πl/w), 0 for l ≥ w

/// Multiplies band l of every channel by window[l].
void applyWindow(const std::vector<double>& window, RgbCoefficients& f);

/// The least attenuation of the family 1/(1+λ l²(l+1)²) that leaves the reconstructed radiance
/// non-negative in every direction (sloan2008stupid, windowing by the squared
/// Laplacian, with λ found by search). Returns the window; λ = 0, all ones, if f is non-negative.
std::vector<double> minimalRinging(const RgbCoefficients& f);

/// The least of the family (1−s) + s ĥ_l, 0 ≤ s ≤ 1, with the ĥ_l of sharpestNonNegative, that leaves
/// f non-negative: s = 1 does wherever f is a non-negative function that was cut to n bands. It keeps
/// more of small lights than minimalRinging. Between the 100 n² directions that are looked at, dips
/// stay below .5% of the peak.
std::vector<double> leastSoftening(const RgbCoefficients& f);
/// The same for a zonal function, such as a lobe.
std::vector<double> leastSoftening(const ZonalMoments& f);

}  // namespace lambent::sh
