// This work is based on:
// - sloan2002precomputed: §3, eq. 6: rotation of zonal functions as an evaluation of the basis.
#include "lambent/light/around_axis.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"

namespace lambent::light {

Vec3d turned(const Mat3& dstFromSrc, const Vec3d& axis) {
  return (dstFromSrc.cast<double>() * axis).normalized();
}

void addZonal(const sh::ZonalMoments& moments, const Vec3d& axis, const Rgb& color,
              std::span<double> out) {
  const std::size_t count = moments.size() * moments.size();
  std::vector<double> one(count);
  sh::turnTo(moments, axis, std::span<double>(one));
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) out[c * count + i] += double(color[c]) * one[i];
}

Vec3d aroundAxis(const Vec3d& axis, double versine, double turn) {
  const Mat3d frame = math::worldFromTangent(axis.cast<float>()).cast<double>();
  // The frame is of single precision: made orthogonal to the axis again in double.
  const Vec3d x = (frame.col(0) - axis * axis.dot(frame.col(0))).normalized();
  const Vec3d y = axis.cross(x);
  const double sine = std::sqrt(std::max(0.0, versine * (2 - versine)));
  return (1 - versine) * axis +
         sine * (std::cos(2 * kPi * turn) * x + std::sin(2 * kPi * turn) * y);
}

}  // namespace lambent::light
