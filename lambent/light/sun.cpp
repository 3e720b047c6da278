// The points lie on a spiral: each on a ring of equal solid angle, the golden angle on from the one
// before. They are walked through in leaps, so that the first few of many are spread over the disc as
// well, and so that a point's place has nothing to do with that of the sub-sample of a pixel which it
// is used for.
#include "lambent/light/sun.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lambent/light/around_axis.h"
#include "lambent/light/component.h"

namespace lambent::light {
namespace {

double diameterOf(const Environment::Disc& disc) {
  return 4 * std::asin(std::sqrt(std::clamp(disc.versine / 2, 0.0, 1.0)));
}

Rgb fluxOf(const Environment::Disc& disc) {
  const sh::RgbCoefficients mean = Environment::disc(disc).project(1);
  return Rgb(mean.channel(0)[0], mean.channel(1)[0], mean.channel(2)[0]) *
         float(std::sqrt(4 * kPi));
}

/// The step of a walk over 0 … count − 1 that visits each once: close to the golden section of it.
int leapOf(int count) {
  int leap = std::max(1, int(std::lround(0.618034 * count)));
  while (std::gcd(leap, count) != 1) ++leap;
  return leap;
}

struct Spot {
  Vec3d direction;
  double mu;
};

/// Those of `count` that stand above the horizon.
std::vector<Spot> spotsAbove(const Environment::Disc& disc, int count) {
  constexpr double kGoldenTurns = 0.3819660112501051;
  const Vec3d axis = disc.axis.cast<double>().normalized(), up = disc.up.cast<double>();
  std::vector<Spot> spots;
  const int leap = leapOf(count);
  for (int i = 0, j = 0; i < count; ++i, j = (j + leap) % count) {
    const double t = (j + 0.5) / count;
    const double turns = j * kGoldenTurns;
    const Vec3d s = aroundAxis(axis, t * disc.versine, turns - std::floor(turns));
    if (up.isZero() || s.dot(up) >= disc.horizon) spots.push_back({s, std::sqrt(1 - t)});
  }
  return spots;
}

}  // namespace

std::optional<Sun> sunOf(const Environment& environment) {
  std::optional<Sun> found;
  for (const Environment::Disc& disc : environment.parts().discs) {
    if (diameterOf(disc) > kLargestSun * (1 + 1e-6)) continue;
    const Rgb flux = fluxOf(disc);
    if (!(flux > 0).any()) continue;
    if (!found || importance(flux) > importance(found->irradiance)) found = Sun{disc, flux};
  }
  return found;
}

Sun turned(const Mat3& dstFromSrc, const Sun& sun) {
  Sun result = sun;
  result.disc.axis = (dstFromSrc * sun.disc.axis).normalized();
  if (!sun.disc.up.isZero()) result.disc.up = (dstFromSrc * sun.disc.up).normalized();
  return result;
}

sh::RgbCoefficients project(const Sun& sun, int bands) {
  return Environment::disc(sun.disc).project(bands);
}

std::vector<SunPoint> pointsOf(const Sun& sun, int count) {
  assert(count >= 1);
  constexpr int kMostTries = 4096;  // of a sliver above the horizon: its uppermost place alone
  std::vector<Spot> spots;
  if (count == 1) {
    constexpr int kEnough = 256;
    const std::vector<Spot> seen = spotsAbove(sun.disc, kEnough);
    Vec3d middle = Vec3d::Zero();
    for (const Spot& spot : seen) middle += spot.direction;
    if (seen.size() == kEnough) middle = sun.disc.axis.cast<double>();
    if (!middle.isZero()) spots.push_back({middle.normalized(), 1.0});
  }
  for (int tries = count; spots.size() < std::size_t(count) && tries <= kMostTries; tries *= 2)
    spots = spotsAbove(sun.disc, tries);
  if (spots.empty()) {
    const Vec3d axis = sun.disc.axis.cast<double>(), up = sun.disc.up.cast<double>();
    const Vec3d rim = (up - up.dot(axis) * axis).normalized();
    const double half = diameterOf(sun.disc) / 2;
    spots.push_back({std::cos(half) * axis + std::sin(half) * rim, 0.0});
  }
  std::vector<SunPoint> points;
  Rgb sum = Rgb::Zero();
  for (std::size_t i = 0; i < std::size_t(count); ++i) {
    const Spot& spot = spots[i % spots.size()];
    const Rgb radiance = sun.disc.radiance * (1 - sun.disc.darkening * float(1 - spot.mu));
    points.push_back({spot.direction.cast<float>(), radiance});
    sum += radiance;
  }
  for (SunPoint& point : points)
    for (int c = 0; c < 3; ++c)
      point.irradiance[c] =
          sum[c] > 0 ? point.irradiance[c] * sun.irradiance[c] * float(count) / sum[c] : 0.0f;
  return points;
}

}  // namespace lambent::light
