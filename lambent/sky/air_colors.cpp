#include "lambent/sky/air_colors.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "lambent/radiometry/spectra.h"

namespace lambent::sky {
namespace {

/// Weights of the values at `nodes` in their cubic at a place: Lagrange's through four around it, or
/// through all if they are fewer.
std::vector<double> cubicWeights(std::span<const double> nodes, double at) {
  const int count = int(nodes.size()), taps = std::min(count, 4);
  const int above = int(std::upper_bound(nodes.begin(), nodes.end(), at) - nodes.begin());
  const int first = std::clamp(above - taps / 2, 0, count - taps);
  std::vector<double> weights(nodes.size());
  for (int i = first; i < first + taps; ++i) {
    double weight = 1;
    for (int j = first; j < first + taps; ++j)
      if (j != i)
        weight *= (at - nodes[std::size_t(j)]) / (nodes[std::size_t(i)] - nodes[std::size_t(j)]);
    weights[std::size_t(i)] = weight;
  }
  return weights;
}

/// RGB of radiances relative to the Sun's irradiance.
Eigen::Matrix3Xd rgbWeights(std::span<const double> wavelengths, const Atmosphere& atmosphere) {
  std::vector<double> fine;
  for (double nm = wavelengths.front(); nm < wavelengths.back(); nm += 1) fine.push_back(nm);
  fine.push_back(wavelengths.back());
  const radiometry::XyzvWeights eye = radiometry::xyzvWeights(fine);
  Eigen::Matrix3Xd weights = Eigen::Matrix3Xd::Zero(3, Eigen::Index(wavelengths.size()));
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const double sun = solarIrradianceOf(atmosphere, fine[k]);
    const Eigen::Array3d rgb =
        radiometry::linearRgbOf(radiometry::Xyzv(eye.col(Eigen::Index(k)).array() * sun));
    const std::vector<double> between = cubicWeights(wavelengths, fine[k]);
    for (std::size_t i = 0; i < between.size(); ++i)
      weights.col(Eigen::Index(i)) += between[i] * rgb.matrix();
  }
  return weights;
}

}  // namespace

AirColors::AirColors(const Scattering& scattering, const Atmosphere& atmosphere,
                     double sunElevation, double sunDistance) {
  const std::vector<double>& wavelengths = scattering.medium().wavelengths;
  assert(!wavelengths.empty());
  radiance_ = rgbWeights(wavelengths, atmosphere) / (sunDistance * sunDistance);
  const GroundLight ground = scattering.onGround(kPi / 2 - sunElevation);
  // Every colour of light will do where there is none.
  double most = 0;
  for (std::size_t i = 0; i < wavelengths.size(); ++i)
    most = std::max(most, ground.diffuse[i] + ground.direct[i]);
  white_ = radiance_;
  for (std::size_t i = 0; i < wavelengths.size(); ++i)
    if (most > 1e-30) white_.col(Eigen::Index(i)) *= (ground.diffuse[i] + ground.direct[i]) / most;
  for (int c = 0; c < 3; ++c) {
    const double sum = white_.row(c).sum();
    // Light of so pure a colour that a primary has no share in it loses what the others do.
    if (sum > 1e-3 * white_.row(c).cwiseAbs().sum())
      white_.row(c) /= sum;
    else
      white_.row(c) = white_.row(c).cwiseAbs() / std::max(white_.row(c).cwiseAbs().sum(), 1e-300);
  }
}

Eigen::Array3d AirColors::radiance(std::span<const double> relative) const {
  return (radiance_ *
          Eigen::Map<const Eigen::VectorXd>(relative.data(), Eigen::Index(relative.size())))
      .array();
}

Eigen::Array3d AirColors::lost(std::span<const double> opticalThickness) const {
  Eigen::VectorXd share(Eigen::Index(opticalThickness.size()));
  for (std::size_t i = 0; i < opticalThickness.size(); ++i)
    share[Eigen::Index(i)] = -std::expm1(-opticalThickness[i]);
  return (white_ * share).array().max(share.minCoeff()).min(share.maxCoeff());
}

}  // namespace lambent::sky
