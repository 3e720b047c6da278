// This work is based on:
// - preetham2003modeling: "Atmosphere": optical mass and optical length.
// - chapman1931absorption: the function of grazing incidence.
#include "lambent/media/optical_length.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/math/types.h"

namespace lambent::media {
namespace {

const math::Quadrature& rule() {
  static const math::Quadrature kRule = math::gaussLegendre(16, 0, 1);
  return kRule;
}

}  // namespace

std::vector<double> smoothPieces(const Shell& shell, double altitude, double cosine, double end,
                                 const std::vector<double>& breaks) {
  std::vector<double> places = {0, end};
  const auto add = [&](double place) {
    if (place > 0 && place < end) places.push_back(place);
  };
  for (const double height : breaks) {
    if (const auto entry = shell.entryAt(height, altitude, cosine)) add(*entry);
    if (const auto exit = shell.exitAt(height, altitude, cosine)) add(*exit);
  }
  const double lowest = -(shell.radius + altitude) * cosine;
  add(lowest);
  // Near its lowest point a ray's altitude is a parabola: a few pieces more, doubling in length.
  const double width = std::sqrt(2 * (shell.radius + altitude) * 500.0);
  for (const double step : {width, 2 * width, 4 * width, 8 * width}) {
    if (std::abs(cosine) > 0.3) break;
    add(lowest - step);
    add(lowest + step);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

double opticalLength(const Shell& shell, const DensityProfile& profile, double altitude,
                     double cosine, double distance) {
  const std::vector<double> places =
      smoothPieces(shell, altitude, cosine, distance, profile.breaks());
  double sum = 0;
  for (std::size_t p = 0; p + 1 < places.size(); ++p) {
    const double length = places[p + 1] - places[p];
    for (std::size_t k = 0; k < rule().nodes.size(); ++k) {
      const double s = places[p] + rule().nodes[k] * length;
      sum += rule().weights[k] * length * profile.at(shell.altitudeAlong(altitude, cosine, s));
    }
  }
  return sum;
}

double opticalLengthToTop(const Shell& shell, const DensityProfile& profile, double altitude,
                          double cosine) {
  const auto exit = shell.exitAt(shell.height, altitude, cosine);
  return exit ? opticalLength(shell, profile, altitude, cosine, *exit) : 0;
}

double chapman(double x, double zenithAngle) {
  // In units of the scale height, with the ground at the point itself.
  const Shell shell{x, 60};
  return opticalLengthToTop(shell, DensityProfile::exponential(1), 0, std::cos(zenithAngle));
}

}  // namespace lambent::media
