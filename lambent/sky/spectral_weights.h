// From the few wavelengths of a table to any wavelength, and to what eyes see.
//
// Radiance for a Sun of irradiance 1 is smooth in wavelength, however the Sun's own spectrum is: its
// logarithm is interpolated by cubics through four wavelengths, and the Sun put in afterwards.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/atmosphere.h"

namespace lambent::sky {

/// Four neighbours of a wavelength among `nodes` (nm, rising, ≥ 4 of them; the wavelength is clamped
/// to them), and their weights.
struct SpectralTaps {
  std::size_t first = 0;
  std::array<float, 4> weight = {};

  SpectralTaps(std::span<const double> nodes, double nm);
  float operator()(const float* logs) const {
    const float* at = logs + first;
    return weight[0] * at[0] + weight[1] * at[1] + weight[2] * at[2] + weight[3] * at[3];
  }
};

/// X, Y, Z and V′ of radiance under an atmosphere's Sun.
class ColorUnderSun {
 public:
  ColorUnderSun() = default;
  ColorUnderSun(std::span<const double> nodes, const Atmosphere& atmosphere);
  /// Of the logarithms at the nodes.
  radiometry::Xyzv operator()(const float* logs) const;

 private:
  std::vector<SpectralTaps> taps_;             ///< every 5 nm
  std::vector<std::array<float, 4>> weights_;  ///< of each, for X, Y, Z and V′
};

}  // namespace lambent::sky
