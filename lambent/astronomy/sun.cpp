#include "lambent/astronomy/sun.h"

#include <cmath>

#include <erfa.h>
#include <erfam.h>

#include "lambent/astronomy/appendix.h"
#include "lambent/astronomy/observer.h"

namespace lambent::astronomy {
namespace {

constexpr double kLightSecondsPerMetre = 1 / ERFA_CMPS;

/// Metres and metres per second, barycentric.
struct EarthAndSun {
  Vec3d earth, earthVelocity, sun;
};

EarthAndSun earthAndSun(const JulianDate& tt, double secondsBefore) {
  // The series wants TDB, which is within 2 ms of TT.
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(tt.day, tt.fraction - secondsBefore / ERFA_DAYSEC, heliocentric, barycentric);
  const Vec3d earth(barycentric[0][0], barycentric[0][1], barycentric[0][2]);
  const Vec3d velocity(barycentric[1][0], barycentric[1][1], barycentric[1][2]);
  const Vec3d fromSun(heliocentric[0][0], heliocentric[0][1], heliocentric[0][2]);
  return {earth * ERFA_DAU, velocity * (ERFA_DAU / ERFA_DAYSEC), (earth - fromSun) * ERFA_DAU};
}

/// The vector (m) at which the Sun is seen from `position`, m and m/s from the Earth's centre.
Vec3d seenSun(const JulianDate& tt, const Vec3d& position, const Vec3d& velocity) {
  const EarthAndSun now = earthAndSun(tt, 0);
  const Vec3d eye = now.earth + position;
  const double lightTime = (now.sun - eye).norm() * kLightSecondsPerMetre;
  const Vec3d seen = earthAndSun(tt, lightTime).sun - eye;
  const double distance = seen.norm();
  return distance * aberrated(seen / distance, now.earthVelocity + velocity);
}

}  // namespace

Topocentric lowPrecisionSun(const Moment& moment, const Place& place) {
  const double t = centuriesSinceJ2000(terrestrialTime(moment));
  // Formulas after jensen2001physically (10), under "Sun". The latitude is 0.
  const double m = 6.24 + 628.302 * t;
  const double longitude = 4.895048 + 628.331951 * t + (0.033417 - 0.000084 * t) * std::sin(m) +
                           0.000351 * std::sin(2 * m);
  const double distance =
      1.000140 - (0.016708 - 0.000042 * t) * std::cos(m) - 0.000141 * std::cos(2 * m);
  const Vec3d ecliptic(std::cos(longitude), std::sin(longitude), 0);
  const Vec3d world =
      appendix::worldFromEquatorial(centuriesSinceJ2000(universalTime(moment)), place) *
      (appendix::equatorialFromEcliptic(t) * ecliptic);
  return {horizontalOf(world), distance * kAstronomicalUnit};
}

Topocentric apparentSun(const Moment& moment, const Place& place) {
  const Observer observer = observerAt(moment, place);
  const Vec3d seen = seenSun(terrestrialTime(moment), observer.position, observer.velocity);
  return {horizontalOf(observer.worldFromCelestial * seen), seen.norm()};
}

Equatorial geocentricSun(const JulianDate& tt) {
  return equatorialOf(trueFromCelestial(tt) * seenSun(tt, Vec3d::Zero(), Vec3d::Zero()));
}

double sunAngularRadius(double distance) {
  return std::asin(kSunRadius / distance);
}

double sunIrradianceScale(double distance) {
  const double ratio = kAstronomicalUnit / distance;
  return ratio * ratio;
}

}  // namespace lambent::astronomy
