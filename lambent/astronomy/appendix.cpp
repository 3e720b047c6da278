#include "lambent/astronomy/appendix.h"

#include <Eigen/Geometry>

namespace lambent::astronomy::appendix {
namespace {

// Counter-clockwise turns about the axes.
Mat3d rx(double angle) {
  return Eigen::AngleAxisd(angle, Vec3d::UnitX()).toRotationMatrix();
}
Mat3d ry(double angle) {
  return Eigen::AngleAxisd(angle, Vec3d::UnitY()).toRotationMatrix();
}
Mat3d rz(double angle) {
  return Eigen::AngleAxisd(angle, Vec3d::UnitZ()).toRotationMatrix();
}

}  // namespace

double obliquity(double centuries) {
  return 0.409093 - 0.000227 * centuries;
}

Mat3d equatorialFromEcliptic(double centuries) {
  return rx(obliquity(centuries));
}

Mat3d precession(double centuries) {
  return rz(0.01118 * centuries) * ry(-0.00972 * centuries) * rz(0.01118 * centuries);
}

double siderealTime(double centuriesUt1, double longitude) {
  return 4.894961 + 230121.675315 * centuriesUt1 + longitude;
}

Mat3d worldFromEquatorial(double centuriesUt1, const Place& place) {
  Mat3d worldFromHorizon;       // south, east, up → east, up, south
  worldFromHorizon << 0, 1, 0,  //
      0, 0, 1,                  //
      1, 0, 0;
  return worldFromHorizon * ry(place.latitude - kPi / 2) *
         rz(-siderealTime(centuriesUt1, place.longitude));
}

}  // namespace lambent::astronomy::appendix
