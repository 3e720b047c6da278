// Spectra of daylight of a given colour.
//
// This work is based on judd1964spectral, as CIE 15 and preetham2003modeling
// have it: S(λ) = S₀(λ) + M₁ S₁(λ) + M₂ S₂(λ) with M₁ and M₂ from the chromaticity.
// Deviation: power is never negative. What is negative becomes 0, before the scale to the
// luminance.
#include <algorithm>
#include <cmath>

#include "lambent/radiometry/spectra.h"

namespace lambent::radiometry {
namespace {

constexpr double kDaylightBasis[][3] = {
#include "lambent/radiometry/daylight_basis.inc"
};
constexpr size_t kDaylightRows = std::size(kDaylightBasis);
constexpr double kFirstDaylight = 300, kDaylightStep = 10;
static_assert(kDaylightRows == 54);

double powerInRow(const DaylightCoefficients& c, size_t row) {
  const double* s = kDaylightBasis[row];
  return s[0] + c.m1 * s[1] + c.m2 * s[2];
}

std::vector<double> wavelengthsOfRows() {
  std::vector<double> nm(kDaylightRows);
  for (size_t row = 0; row < kDaylightRows; ++row) {
    nm[row] = kFirstDaylight + kDaylightStep * double(row);
  }
  return nm;
}

double linearInRows(std::span<const double> power, double nm) {
  const double u = (nm - kFirstDaylight) / kDaylightStep;
  if (!(u >= 0 && u <= double(kDaylightRows - 1))) {
    return 0;
  }
  const size_t i = std::min(size_t(u), kDaylightRows - 2);
  const double t = u - double(i);
  return (1 - t) * power[i] + t * power[i + 1];
}

}  // namespace

DaylightCoefficients daylightCoefficients(double x, double y) {
  const double denominator = std::min(.0241 + .2562 * x - .7341 * y, -.001);
  return {(-1.3515 - 1.7703 * x + 5.9114 * y) / denominator,
          (.0300 - 31.4424 * x + 30.0717 * y) / denominator};
}

double daylightPower(const DaylightCoefficients& coefficients, double nm) {
  double power[kDaylightRows];
  for (size_t row = 0; row < kDaylightRows; ++row) {
    power[row] = powerInRow(coefficients, row);
  }
  return linearInRows(power, nm);
}

std::vector<double> daylightSpectrum(double x, double y, double luminance,
                                     std::span<const double> nm) {
  static const XyzvWeights weights = xyzvWeights(wavelengthsOfRows());
  const DaylightCoefficients coefficients = daylightCoefficients(x, y);
  Eigen::VectorXd power(kDaylightRows);
  for (size_t row = 0; row < kDaylightRows; ++row) {
    power[Eigen::Index(row)] = std::max(powerInRow(coefficients, row), 0.0);
  }
  // The power at 560 nm is 100 whatever the coefficients: there is always something to scale.
  power *= luminance / weights.row(1).dot(power);
  std::vector<double> spectrum(nm.size());
  std::ranges::transform(nm, spectrum.begin(), [&](double at) {
    return linearInRows({power.data(), kDaylightRows}, at);
  });
  return spectrum;
}

Xyzv daylightXyzv(double x, double y, double luminance) {
  // Y and V′ of the three functions of the basis.
  static const Eigen::Matrix<double, 2, 3, Eigen::DontAlign> ofBasis = [] {
    const XyzvWeights weights = xyzvWeights(wavelengthsOfRows());
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> basis(
        kDaylightBasis[0], kDaylightRows, 3);
    return Eigen::Matrix<double, 2, 3, Eigen::DontAlign>(
        weights.bottomRows<3>()(std::array{0, 2}, Eigen::all) * basis);
  }();
  const DaylightCoefficients c = daylightCoefficients(x, y);
  const Vec2d yv = ofBasis * Vec3d(1, c.m1, c.m2);
  const double scotopic = yv[0] > 0 ? std::max(yv[1] / yv[0], 0.0) : 0;
  const double divisor = std::max(y, 1e-6);
  return {luminance * x / divisor, luminance, luminance * (1 - x - y) / divisor,
          luminance * scotopic};
}

}  // namespace lambent::radiometry
