// Windowing: attenuating the high bands against ringing.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lambent/sh/coefficients.h"

namespace lambent::sh {

std::vector<double> hann(int bands, double width);     ///< (1+cos(πl/w))/2, 0 for l ≥ w
std::vector<double> lanczos(int bands, double width);  ///< sin(πl/w)/(πl/w), 0 for l ≥ w

/// Multiplies band l of every channel by window[l].
void applyWindow(const std::vector<double>& window, RgbCoefficients& f);

/// The least attenuation of the family 1/(1+λ l²(l+1)²) that leaves the reconstructed radiance
/// non-negative in every direction (sloan2008stupid, windowing by the squared
/// Laplacian, with λ found by search). Returns the window; λ = 0, all ones, if f is non-negative.
std::vector<double> minimalRinging(const RgbCoefficients& f);

}  // namespace lambent::sh
