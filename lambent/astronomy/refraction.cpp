#include "lambent/astronomy/refraction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lambent::astronomy {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kJoin = -1;  // degrees: above it the published formula holds

/// A function of the elevation in degrees, with its first two derivatives.
struct Jet {
  double value, slope, curvature;
};

/// Minutes of arc.
Jet saemundsson(double h) {
  const double reach = h + 5.11;
  const double angle = (h + 10.3 / reach) * kDegree;
  const double d1 = (1 - 10.3 / (reach * reach)) * kDegree;
  const double d2 = 2 * 10.3 / (reach * reach * reach) * kDegree;
  const double cotangent = 1 / std::tan(angle);
  const double cosecant2 = 1 + cotangent * cotangent;
  return {1.02 * cotangent + 0.0019279, -1.02 * cosecant2 * d1,
          1.02 * cosecant2 * (2 * cotangent * d1 * d1 - d2)};
}

double minutes(double h) {
  if (h >= kJoin) return saemundsson(h).value;
  // (a + b x + c x²) e^−x with derivatives b − a and 2 c − 2 b + a at x = 0, where x runs down.
  static const Jet join = saemundsson(kJoin);
  const double a = join.value;
  const double b = a - join.slope;
  const double c = (join.curvature + 2 * b - a) / 2;
  const double x = kJoin - h;
  return (a + b * x + c * x * x) * std::exp(-x);
}

}  // namespace

Result<Air> airFromCelsius(double celsius, double hectopascals) {
  if (!(celsius >= -100 && celsius <= 70))
    return report::badUsage(
        fmt::format("the temperature {} of the air: degrees Celsius from -100 to 70", celsius));
  if (!(hectopascals >= 0 && hectopascals <= 1200))
    return report::badUsage(
        fmt::format("the pressure {} of the air: hectopascals from 0 to 1200", hectopascals));
  return Air{celsius + 273.15, 100 * hectopascals};
}

Air standardAir(double altitude) {
  constexpr double kExponent = 5.255877;   // g M / (R · 6.5 K/km)
  constexpr double kScaleHeight = 6341.6;  // R · 216.65 K / (g M)
  const double inTroposphere = std::min(altitude, 11000.0);
  const double temperature = 288.15 - 0.0065 * inTroposphere;
  const double above = altitude - inTroposphere;
  return {temperature,
          101325 * std::pow(temperature / 288.15, kExponent) * std::exp(-above / kScaleHeight)};
}

double refraction(double trueElevation, const Air& air) {
  const double density = air.pressure / 101000 * 283 / air.temperature;
  return density * minutes(trueElevation / kDegree) / 60 * kDegree;
}

Horizontal refracted(const Horizontal& trueDirection, const Air& air) {
  const double seen = trueDirection.elevation + refraction(trueDirection.elevation, air);
  return {trueDirection.azimuth, std::min(seen, kPi / 2)};
}

}  // namespace lambent::astronomy
