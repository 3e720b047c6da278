#include "lambent/astronomy/observer.h"

#include <cmath>

#include <erfa.h>
#include <erfam.h>

namespace lambent::astronomy {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Vec3d vectorOf(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

}  // namespace

Mat3d trueFromCelestial(const JulianDate& tt) {
  double matrix[3][3];
  eraPnm06a(tt.day, tt.fraction, matrix);
  return Eigen::Map<const RowMajor>(&matrix[0][0]);
}

Observer observerAt(const Moment& moment, const Place& place) {
  const JulianDate tt = terrestrialTime(moment), ut1 = universalTime(moment);
  double matrix[3][3];
  eraPnm06a(tt.day, tt.fraction, matrix);
  const Mat3d ofDate = Eigen::Map<const RowMajor>(&matrix[0][0]);
  const double sidereal = eraGst06(ut1.day, ut1.fraction, tt.day, tt.fraction, matrix);
  double motion[2][3];
  eraPvtob(place.longitude, place.latitude, place.altitude, 0, 0, 0, sidereal, motion);

  const double theta = sidereal + place.longitude;
  const double sinTheta = std::sin(theta), cosTheta = std::cos(theta);
  const double sinPhi = std::sin(place.latitude), cosPhi = std::cos(place.latitude);
  Mat3d worldFromTrue;
  worldFromTrue << -sinTheta, cosTheta, 0,            // east
      cosPhi * cosTheta, cosPhi * sinTheta, sinPhi,   // up
      sinPhi * cosTheta, sinPhi * sinTheta, -cosPhi;  // south
  return {ofDate.transpose() * vectorOf(motion[0]), ofDate.transpose() * vectorOf(motion[1]),
          worldFromTrue * ofDate};
}

Vec3d aberrated(const Vec3d& direction, const Vec3d& velocity) {
  double natural[3] = {direction.x(), direction.y(), direction.z()};
  double v[3] = {velocity.x() / ERFA_CMPS, velocity.y() / ERFA_CMPS, velocity.z() / ERFA_CMPS};
  const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  double proper[3];
  eraAb(natural, v, 1, std::sqrt(1 - squared), proper);
  return vectorOf(proper);
}

Equatorial equatorialOf(const Vec3d& vector) {
  const double angle = std::atan2(vector.y(), vector.x());
  return {angle < 0 ? angle + 2 * kPi : angle,
          std::atan2(vector.z(), std::hypot(vector.x(), vector.y())), vector.norm()};
}

}  // namespace lambent::astronomy
