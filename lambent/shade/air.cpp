#include "lambent/shade/air.h"

#include <algorithm>
#include <cmath>

#include "lambent/sky/aerial_table.h"
#include "lambent/sky/shafts.h"

namespace lambent::shade {

Rgb Air::seen(const Vec3& direction, float distance, const Rgb& radiance) const {
  const sky::AirBetween between =
      table->at(sunFromAsset * direction.cast<double>(), double(distance) * metresPerUnit);
  return between.seen(radiance.cast<double>()).cast<float>();
}

Rgb Air::seenBehind(const Vec3& direction, const Rgb& radiance) const {
  const Vec3d inSunFrame = sunFromAsset * direction.cast<double>();
  const double elevation = std::asin(std::clamp(inSunFrame.y(), -1.0, 1.0));
  const sky::AirTableAxes& axes = table->axes();
  if (axes.isAbove(elevation)) return radiance;
  return table->at(inSunFrame, axes.toGround(elevation))
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
