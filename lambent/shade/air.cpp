#include "lambent/shade/air.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/aerial_table.h"
#include "lambent/sky/shafts.h"

namespace lambent::shade {

namespace {

sky::AirBetween airOf(const Air& air, const Vec3d& inSunFrame, double metres) {
  return air.exact ? air.exact->at(inSunFrame, metres) : air.table->at(inSunFrame, metres);
}

}  // namespace

sky::AirBetween Air::between(const Vec3& direction, float distance) const {
  return airOf(*this, sunFromAsset * direction.cast<double>(), double(distance) * metresPerUnit);
}

Rgb Air::seen(const Vec3& direction, float distance, const Rgb& radiance) const {
  return between(direction, distance).seen(radiance.cast<double>()).cast<float>();
}

Rgb Air::seenBehind(const Vec3& from, const Vec3& direction, const Rgb& radiance) const {
  const Vec3d inSunFrame = sunFromAsset * direction.cast<double>();
  const double elevation = std::asin(std::clamp(inSunFrame.y(), -1.0, 1.0));
  const sky::AirTableAxes& axes = table->axes();
  if (axes.isAbove(elevation)) return radiance;
  const double inScene = metresPerUnit * sunFromAsset.row(1).dot((from - ground).cast<double>());
  const double height = std::max({axes.altitude, inScene, kLeastEyeHeight});
  return airOf(*this, inSunFrame, axes.toGround(elevation, height))
      .seen(radiance.cast<double>())
      .cast<float>();
}

sky::SamplingPlanes Air::planes(const scene::Camera& camera, const scene::Box& box) const {
  const Vec3 axis = -camera.worldFromCamera.block<3, 1>(0, 2).normalized();
  const Vec3 eye = camera.worldFromCamera.block<3, 1>(0, 3);
  const Vec3 farthest((axis.array() > 0).select(box.upper.array(), box.lower.array()));
  const double end = std::max(double(axis.dot(farthest - eye)), 1e-3) * metresPerUnit;
  sky::SamplingPlanes result;
  result.axis = sunFromAsset * axis.cast<double>();
  result.first = 0;
  result.last = end;
  result.count = shafts->planes;
  result.samples = shafts->samples;
  return result;
}

}  // namespace lambent::shade
