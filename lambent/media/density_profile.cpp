// This work is based on:
// - coesa1976us: table 4 (layers) and eq. 33 (pressure); the density of a perfect gas.
#include "lambent/media/density_profile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "lambent/math/quadrature.h"

namespace lambent::media {
namespace {

struct Layer {
  double base;         ///< geopotential altitude, km
  double lapse;        ///< K/km
  double temperature;  ///< K, at the base
  double density;      ///< kg/m³, at the base
};
// Densities follow from hydrostatic balance, layer upon layer (coesa1976us rounds them alike).
constexpr std::array<Layer, 8> kLayers = {{{0, -6.5, 288.15, 1.225},
                                           {11, 0, 216.65, 0.363918},
                                           {20, 1, 216.65, 0.0880348},
                                           {32, 2.8, 228.65, 0.013225},
                                           {47, 0, 270.65, 0.00142753},
                                           {51, -2.8, 270.65, 0.000861605},
                                           {71, -2, 214.65, 6.4211e-05},
                                           {84.852, 0, 186.946, 6.95788e-06}}};
constexpr double kEarthRadius = 6356.766;  // km, of the geopotential
constexpr double kGravity = 34.163195;     // g₀ M / R*, K/km

double usStandard(double altitude) {
  const double z = altitude / 1000;
  const double h = kEarthRadius * z / (kEarthRadius + z);
  std::size_t k = 0;
  while (k + 1 < kLayers.size() && h >= kLayers[k + 1].base) ++k;
  const Layer& layer = kLayers[k];
  const double above = h - layer.base;
  if (layer.lapse == 0)
    return layer.density / 1.225 * std::exp(-kGravity * above / layer.temperature);
  const double temperature = layer.temperature + layer.lapse * above;
  return layer.density / 1.225 *
         std::pow(temperature / layer.temperature, -kGravity / layer.lapse - 1);
}

struct At {
  double altitude;
  double operator()(const DensityProfile::Exponential& law) const {
    return std::exp(-altitude / law.scaleHeight);
  }
  double operator()(const DensityProfile::UsStandard1976&) const {
    return usStandard(std::max(altitude, -5000.0));
  }
  double operator()(const DensityProfile::Tabulated& law) const {
    const auto& points = law.points;
    const auto above = std::upper_bound(
        points.begin(), points.end(), altitude,
        [](double a, const DensityProfile::Point& point) { return a < point.altitude; });
    if (above == points.begin()) return points.front().density;
    if (above == points.end()) return points.back().density;
    const auto below = above - 1;
    const double t = (altitude - below->altitude) / (above->altitude - below->altitude);
    return (1 - t) * below->density + t * above->density;
  }
};

struct Breaks {
  std::vector<double> operator()(const DensityProfile::Exponential& law) const {
    std::vector<double> altitudes;
    // Not for smoothness: so that a few nodes between them follow the exponential.
    for (const double scale : {0.5, 1.0, 2.0, 3.0, 4.5, 6.5, 9.0})
      altitudes.push_back(scale * law.scaleHeight);
    return altitudes;
  }
  std::vector<double> operator()(const DensityProfile::UsStandard1976&) const {
    std::vector<double> altitudes = {4000};
    for (std::size_t k = 1; k < kLayers.size(); ++k)
      altitudes.push_back(1000 * kEarthRadius * kLayers[k].base / (kEarthRadius - kLayers[k].base));
    return altitudes;
  }
  std::vector<double> operator()(const DensityProfile::Tabulated& law) const {
    std::vector<double> altitudes;
    for (const auto& point : law.points) altitudes.push_back(point.altitude);
    altitudes.erase(std::unique(altitudes.begin(), altitudes.end()), altitudes.end());
    return altitudes;
  }
};

}  // namespace

DensityProfile DensityProfile::tabulated(std::vector<Point> points) {
  assert(!points.empty() &&
         std::is_sorted(points.begin(), points.end(),
                        [](const Point& a, const Point& b) { return a.altitude < b.altitude; }));
  return {Tabulated{std::move(points)}};
}

double DensityProfile::at(double altitude) const {
  return std::visit(At{altitude}, law_);
}

std::vector<double> DensityProfile::breaks() const {
  std::vector<double> altitudes = std::visit(Breaks{}, law_);
  std::erase_if(altitudes, [](double altitude) { return !(altitude > 0); });
  return altitudes;
}

std::vector<double> DensityProfile::kinks() const {
  return std::holds_alternative<Tabulated>(law_) ? breaks() : std::vector<double>();
}

double DensityProfile::column(double top) const {
  std::vector<double> ends = breaks();
  std::erase_if(ends, [top](double altitude) { return altitude >= top; });
  ends.push_back(top);
  double sum = 0, from = 0;
  for (const double to : ends) {
    const math::Quadrature rule = math::gaussLegendre(16, from, to);
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) sum += rule.weights[k] * at(rule.nodes[k]);
    from = to;
  }
  return sum;
}

}  // namespace lambent::media
