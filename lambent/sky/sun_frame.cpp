#include "lambent/sky/sun_frame.h"

#include <algorithm>
#include <cmath>

namespace lambent::sky {

double modelledElevation(double sunElevation) {
  return std::clamp(sunElevation, 0.0, kPi / 2);
}

Vec3d sunDirection(double sunElevation) {
  return {std::cos(sunElevation), std::sin(sunElevation), 0};
}

SkyAngles skyAngles(const Vec3d& direction, const Vec3d& sun) {
  Vec3d at = direction;
  if (at.y() < 0) {
    at.y() = 0;
    const double length = at.norm();
    at = length > 0 ? Vec3d(at / length) : Vec3d(0, 0, 1);
  }
  SkyAngles angles;
  angles.cosZenith = std::min(at.y(), 1.0);
  angles.zenith = std::acos(angles.cosZenith);
  // Of the chord, which keeps its digits where the cosine has none left.
  angles.sun = 2 * std::asin(std::min((at - sun).norm() / 2, 1.0));
  angles.cosSun = std::cos(angles.sun);
  return angles;
}

double Gradation::at(double cosZenith) const {
  return std::max(1 + a * std::exp(b / std::max(cosZenith, .01)), 0.0);
}

double Indicatrix::at(const SkyAngles& angles) const {
  return std::max(k + c * std::exp(d * angles.sun) + e * angles.cosSun * angles.cosSun, 0.0);
}

}  // namespace lambent::sky
