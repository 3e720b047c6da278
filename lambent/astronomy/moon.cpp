#include "lambent/astronomy/moon.h"

#include <cmath>

#include <erfa.h>
#include <erfam.h>
#include <Eigen/Geometry>

#include "lambent/astronomy/appendix.h"
#include "lambent/astronomy/observer.h"

namespace lambent::astronomy {
namespace {

Vec3d geometricMoon(const JulianDate& tt, double secondsBefore) {
  double motion[2][3];
  eraMoon98(tt.day, tt.fraction - secondsBefore / ERFA_DAYSEC, motion);
  return Vec3d(motion[0][0], motion[0][1], motion[0][2]) * ERFA_DAU;
}

/// The vector (m) at which the Moon is seen from `position`, m and m/s from the Earth's centre. The
/// Earth's own motion in the light's time cancels with its aberration: what is left is the Moon's
/// motion about the Earth and the observer's.
Vec3d seenMoon(const JulianDate& tt, const Vec3d& position, const Vec3d& velocity) {
  const double lightTime = (geometricMoon(tt, 0) - position).norm() / ERFA_CMPS;
  const Vec3d seen = geometricMoon(tt, lightTime) - position;
  const double distance = seen.norm();
  return distance * aberrated(seen / distance, velocity);
}

Vec3d vectorTo(const Topocentric& body) {
  return body.distance * worldDirection(body.direction);
}

}  // namespace

Topocentric lowPrecisionMoon(const Moment& moment, const Place& place) {
  const double t = centuriesSinceJ2000(terrestrialTime(moment));
  // Formulas after jensen2001physically (10), under "Moon", as printed. Its m should begin with
  // 6.2400, as the Sun's does (7″), its m′ with 2.3556 (5″) and its l′ with 3.8103 (12″): all that
  // together makes the worst error 6.9′ instead of 6.6′, so the printed numbers stay.
  const double l = 3.8104 + 8399.7091 * t;
  const double m = 6.2300 + 628.3019 * t;
  const double f = 1.6280 + 8433.4663 * t;
  const double p = 2.3554 + 8328.6911 * t;  // m′
  const double d = 5.1985 + 7771.3772 * t;
  const auto sin = [](double x) { return std::sin(x); };
  const auto cos = [](double x) { return std::cos(x); };
  const double longitude = l + 0.1098 * sin(p) + 0.0222 * sin(2 * d - p) + 0.0115 * sin(2 * d) +
                           0.0037 * sin(2 * p) - 0.0032 * sin(m) - 0.0020 * sin(2 * f) +
                           0.0010 * sin(2 * d - 2 * p) + 0.0010 * sin(2 * d - m - p) +
                           0.0009 * sin(2 * d + p) + 0.0008 * sin(2 * d - m) + 0.0007 * sin(p - m) -
                           0.0006 * sin(d) - 0.0005 * sin(m + p);
  const double latitude = 0.0895 * sin(f) + 0.0049 * sin(p + f) + 0.0048 * sin(p - f) +
                          0.0030 * sin(2 * d - f) + 0.0010 * sin(2 * d + f - p) +
                          0.0008 * sin(2 * d - f - p) + 0.0006 * sin(2 * d + f);
  const double parallax = 0.016593 + 0.000904 * cos(p) + 0.000166 * cos(2 * d - p) +
                          0.000137 * cos(2 * d) + 0.000049 * cos(2 * p) +
                          0.000015 * cos(2 * d + p) + 0.000009 * cos(2 * d - m);
  const double level = std::cos(latitude) / parallax;  // equatorial radii of the Earth
  const Vec3d ecliptic(level * std::cos(longitude), level * std::sin(longitude),
                       std::sin(latitude) / parallax);
  const Vec3d geocentric =
      appendix::worldFromEquatorial(centuriesSinceJ2000(universalTime(moment)), place) *
      (appendix::equatorialFromEcliptic(t) * ecliptic);
  const Vec3d seen = geocentric - Vec3d::UnitY();  // the observer stands one radius up
  return {horizontalOf(seen), seen.norm() * kEarthRadius};
}

Topocentric apparentMoon(const Moment& moment, const Place& place) {
  const Observer observer = observerAt(moment, place);
  const Vec3d seen = seenMoon(terrestrialTime(moment), observer.position, observer.velocity);
  return {horizontalOf(observer.worldFromCelestial * seen), seen.norm()};
}

Equatorial geocentricMoon(const JulianDate& tt) {
  return equatorialOf(trueFromCelestial(tt) * seenMoon(tt, Vec3d::Zero(), Vec3d::Zero()));
}

double moonAngularRadius(double distance) {
  return std::asin(kMoonRadius / distance);
}

double phaseAngle(const Topocentric& sun, const Topocentric& moon) {
  const Vec3d m = vectorTo(moon);
  const Vec3d toSun = vectorTo(sun) - m;
  return std::atan2(toSun.cross(-m).norm(), toSun.dot(-m));
}

double illuminatedFraction(double phaseAngle) {
  return (1 + std::cos(phaseAngle)) / 2;
}

Vec3d terminatorDirection(const Topocentric& sun, const Topocentric& moon) {
  const Vec3d s = vectorTo(sun), m = vectorTo(moon);
  const Vec3d direction = (s - m).cross(s.cross(m));
  const double length = direction.norm();
  if (!(length > 1e-12 * s.norm() * s.norm() * m.norm())) return Vec3d::Zero();
  return direction / length;
}

}  // namespace lambent::astronomy
