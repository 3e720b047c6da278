// This work is based on:
// - bruneton2008precomputed: §4, light scattered once is tabulated without the phase functions. Ours is
//   of one viewer and one Sun, so that it is small and made anew within a frame or two; what is kept is
//   the mean source L_in / (1 − f), which is smooth from the viewer's nose to the top of the air.
//
// Simulate: AirTable() marches along a ray for each elevation and azimuth, up to all distances.
// Encode:   fillRay() keeps what changes slowly along it.
// Evaluate: at().
#include "lambent/sky/aerial_table.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/sun_frame.h"

namespace lambent::sky {
namespace {

constexpr double kLeast = 1e-30;  ///< where its logarithm is asked for

struct Pair {
  int low;
  double share;  ///< of the next
};
Pair between(double place, int count) {
  const double at = std::clamp(place, 0.0, 1.0) * (count - 1);
  const int low = std::min(int(at), count - 2);
  return {low, at - low};
}

}  // namespace

double AirTableAxes::placeOfElevation(double elevation) const {
  const double above = elevation - horizon;
  return std::pow(above >= 0 ? above / (kPi / 2 - horizon) : -above / (kPi / 2 + horizon),
                  1 / kElevationPower);
}

double AirTableAxes::elevationOf(bool above, double place) const {
  const double x = std::pow(place, kElevationPower);
  return above ? horizon + x * (kPi / 2 - horizon) : horizon - x * (kPi / 2 + horizon);
}

double AirTableAxes::toGround(double elevation, double above) const {
  const double b = (radius + above) * std::sin(elevation);
  const double c = above * (2 * radius + above);
  const double root = std::sqrt(std::max(b * b - c, 0.0));
  return c / std::max({root - b, std::sqrt(c), 1e-3});
}

double AirTableAxes::reach(bool above, double elevation) const {
  const double b = (radius + altitude) * std::sin(elevation);
  if (above) {
    const double c = (height - altitude) * (2 * radius + height + altitude);
    const double root = std::sqrt(b * b + c);
    return std::max(b > 0 ? c / (root + b) : root - b, 1.0);
  }
  return std::max(toGround(elevation), kLeastReach);
}

AirTable::AirTable(const Scattering& scattering, const Atmosphere& atmosphere,
                   const ViewerInAir& viewer, const AirTableSize& size)
    : size_(size),
      sun_(sunDirection(viewer.sunElevation)),
      aerosolPhase_(scattering.medium().aerosolPhase) {
  const media::Shell& shell = scattering.medium().shell;
  axes_ = {shell.radius, shell.height, viewer.altitude,
           kPi / 2 - scattering.horizonZenith(viewer.altitude)};
  const AirColors colors(scattering, atmosphere, viewer.sunElevation, viewer.sunDistance);
  const std::size_t rows = std::size_t(size.distances) * size.elevations;
  for (std::vector<float>& source : sources_) source.resize(rows * size.azimuths * 3);
  extinction_.resize(rows * 3);
  AirStretches stretches;
  for (int j = 0; j < size.elevations; ++j)
    for (int i = 0; i < size.azimuths; ++i) fillRay(scattering, colors, j, i, stretches);

  float most = 0;
  for (const auto& source : sources_)
    for (const float value : source) most = std::max(most, std::abs(value));
  scale_ = most > 0 ? most / 1024 : 1;
  for (auto& source : sources_)
    for (float& value : source) value /= scale_;
}

void AirTable::fillRay(const Scattering& scattering, const AirColors& colors, int j, int i,
                       AirStretches& stretches) {
  const int half = size_.elevations / 2;
  const bool above = j >= half;
  const double elevation = axes_.elevationOf(above, double(j - (above ? half : 0)) / (half - 1));
  const double azimuth = kPi * i / (size_.azimuths - 1);
  const double reach = axes_.reach(above, elevation);
  std::vector<double> ends(std::size_t(size_.distances));
  for (std::size_t k = 1; k < ends.size(); ++k)
    ends[k] = reach * std::pow(double(k) / (size_.distances - 1), AirTableAxes::kDistancePower);
  ends[0] = 1e-3 * ends[1];  // as good as none: the limit is wanted
  const Vec3d direction(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                        std::cos(elevation) * std::sin(azimuth));
  const RayInAir ray{axes_.altitude, direction.y(), std::acos(std::clamp(sun_.y(), -1.0, 1.0)),
                     std::clamp(direction.dot(sun_), -1.0, 1.0)};
  scattering.upTo(ray, ends, size_.nodes, stretches);
  const std::size_t count = scattering.medium().wavelengths.size();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto spectrum = [&](const std::vector<double>& of) {
      return std::span(of).subspan(k * count, count);
    };
    const Eigen::Array3d lost = colors.lost(spectrum(stretches.depth)).max(kLeast);
    const std::size_t row = k * size_.elevations + j, at = row * size_.azimuths + i;
    const Eigen::Array3d parts[] = {colors.radiance(spectrum(stretches.air)) / lost,
                                    colors.radiance(spectrum(stretches.aerosol)) / lost,
                                    colors.radiance(spectrum(stretches.multiple)) / lost};
    for (int c = 0; c < 3; ++c) {
      for (int part = 0; part < 3; ++part) sources_[part][at * 3 + c] = float(parts[part][c]);
      if (i == 0)
        extinction_[row * 3 + c] =
            float(std::log(std::max(-std::log1p(-std::min(lost[c], 1 - 1e-15)), kLeast) / ends[k]));
    }
  }
}

AirBetween AirTable::at(const Vec3d& direction, double distance) const {
  if (!(distance > 0)) return {};
  const double elevation = std::asin(std::clamp(direction.y(), -1.0, 1.0));
  const bool above = axes_.isAbove(elevation);
  const double reach = axes_.reach(above, elevation);
  // There is nothing above the air; what is below the ground is air too.
  const double far = std::min(distance, above ? reach : kEndless);
  const int half = size_.elevations / 2;
  const Pair u = between(std::atan2(std::abs(direction.z()), direction.x()) / kPi, size_.azimuths);
  Pair v = between(axes_.placeOfElevation(elevation), half);
  v.low += above ? half : 0;
  const Pair w = between(std::pow(far / reach, 1 / AirTableAxes::kDistancePower), size_.distances);

  Eigen::Array3d logExtinction = Eigen::Array3d::Zero(), sources[3];
  for (Eigen::Array3d& source : sources) source.setZero();
  for (int corner = 0; corner < 4; ++corner) {
    const int high = corner & 1, farther = corner >> 1;
    const double weight = (high ? v.share : 1 - v.share) * (farther ? w.share : 1 - w.share);
    const std::size_t row = std::size_t(w.low + farther) * size_.elevations + (v.low + high);
    for (int c = 0; c < 3; ++c) {
      logExtinction[c] += weight * double(extinction_[row * 3 + c]);
      for (int part = 0; part < 3; ++part) {
        const float* source = &sources_[part][(row * size_.azimuths + u.low) * 3 + c];
        sources[part][c] +=
            weight * ((1 - u.share) * double(source[0]) + u.share * double(source[3]));
      }
    }
  }
  const Eigen::Array3d depth = logExtinction.exp() * far;
  const Eigen::Array3d lost = depth.unaryExpr([](double x) { return -std::expm1(-x); });
  const double towardsSun = std::clamp(direction.dot(sun_), -1.0, 1.0);
  return {1 - lost,
          lost * double(scale_) *
              (sources[Air] * media::evaluate(media::RayleighPhase{}, towardsSun) +
               sources[Aerosol] * media::evaluate(aerosolPhase_, towardsSun)),
          lost * double(scale_) * sources[Multiple]};
}

}  // namespace lambent::sky
