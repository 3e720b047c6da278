#include "lambent/sky/sight.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lambent::sky {

namespace {

bool isBelow(const Sky& sky, const Vec3d& direction) {
  return direction.y() < std::sin(sky.horizon);
}

}  // namespace

BelowHorizon belowHorizonOf(Model model) {
  return model == Model::Exact || model == Model::Fast ? BelowHorizon::Dome : BelowHorizon::Ground;
}

radiometry::Xyzv colorSeen(const Sky& sky, BelowHorizon below, const Vec3d& direction) {
  if (below == BelowHorizon::Dome || !isBelow(sky, direction)) return sky.dome->color(direction);
  if (below == BelowHorizon::Ground) return sky.ground;
  return radiometry::Xyzv::Zero();
}

void spectrumSeen(const Sky& sky, BelowHorizon below, const Vec3d& direction,
                  std::span<const double> wavelengths, std::span<double> radiance) {
  assert(wavelengths.size() == radiance.size());
  if (below == BelowHorizon::Dome || !isBelow(sky, direction))
    return sky.dome->spectrum(direction, wavelengths, radiance);
  for (std::size_t i = 0; i < radiance.size(); ++i)
    radiance[i] =
        below == BelowHorizon::Ground ? spectrumAt(sky, sky.groundRadiance, wavelengths[i]) : 0.0;
}

double spectrumAt(const Sky& sky, std::span<const double> values, double nanometres) {
  const std::vector<double>& nm = sky.wavelengths;
  if (values.empty()) return 0.0;
  assert(values.size() == nm.size());
  const auto next = std::upper_bound(nm.begin(), nm.end(), nanometres);
  if (next == nm.begin()) return values.front();
  if (next == nm.end()) return values.back();
  const auto i = std::size_t(next - nm.begin());
  const double t = (nanometres - nm[i - 1]) / (nm[i] - nm[i - 1]);
  return values[i - 1] + t * (values[i] - values[i - 1]);
}

Rgb radianceRgb(const radiometry::Xyzv& xyzv) {
  return withinGamut(radiometry::linearRgbOf(xyzv));
}

Rgb withinGamut(const Eigen::Array3d& rgb) {
  const double least = rgb.minCoeff();
  if (!(least < 0.0)) return rgb.cast<float>();
  const double grey = std::max(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], 0.0);
  return (grey + grey / (grey - least) * (rgb - grey)).max(0.0).cast<float>();
}

}  // namespace lambent::sky
