// Vectors of spherical-harmonic coefficients. Real, orthonormal basis, polar axis +z, positive
// signs (Y₁₁ = +0.488603 x); index l(l+1)+m from 0. n bands have n² coefficients.
#pragma once

#include <cassert>
#include <cmath>
#include <span>
#include <vector>

namespace lambent::sh {

inline constexpr int kMaxBands = 10;  ///< of a light or a transfer vector; the basis itself goes on

constexpr int coefficientCount(int bands) {
  return bands * bands;
}
constexpr int index(int l, int m) {
  return l * (l + 1) + m;
}
/// The band l that coefficient i belongs to.
constexpr int bandOf(int i) {
  int l = 0;
  while ((l + 1) * (l + 1) <= i) ++l;
  return l;
}

/// The number of bands that `count` coefficients make; asserts that count is a square.
constexpr int bandsOf(std::size_t count) {
  int bands = 0;
  while (std::size_t(bands) * std::size_t(bands) < count) ++bands;
  assert(std::size_t(bands) * std::size_t(bands) == count);
  return bands;
}

/// A spherical function of three channels, linear RGB: an environment's radiance (W m⁻² sr⁻¹).
struct RgbCoefficients {
  int bands = 0;
  std::vector<float> values;  ///< 3·n², channel after channel

  RgbCoefficients() = default;
  explicit RgbCoefficients(int bandCount)
      : bands(bandCount), values(3 * static_cast<std::size_t>(coefficientCount(bandCount))) {}

  std::span<float> channel(int c) {
    return {values.data() + c * coefficientCount(bands), size_t(coefficientCount(bands))};
  }
  std::span<const float> channel(int c) const {
    return {values.data() + c * coefficientCount(bands), size_t(coefficientCount(bands))};
  }
};

/// The same function with fewer bands (cut) or more (zeros).
RgbCoefficients withBands(const RgbCoefficients& f, int bands);

}  // namespace lambent::sh
