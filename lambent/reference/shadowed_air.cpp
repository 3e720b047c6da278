#include "lambent/reference/shadowed_air.h"

#include <algorithm>

namespace lambent::reference {
namespace {

sky::AerialPerspective formOf(const shade::Air& air) {
  return air.exact ? sky::AerialPerspective(*air.exact) : sky::AerialPerspective(*air.table);
}

}  // namespace

ShadowedAir::ShadowedAir(const shade::Air& air, const trace::RayScene& rays,
                         const scene::Camera& camera, const scene::Box& box, By by)
    : air_(air), rays_(rays), form_(formOf(air)), planes_(air.planes(camera, box)), by_(by) {}

Rgb ShadowedAir::missing(const scene::Ray& ray, std::optional<float> distance,
                         const Vec3& towardsSun) const {
  sky::ShaftRay shaft;
  shaft.direction = air_.sunFromAsset * ray.direction.cast<double>();
  shaft.length = distance ? double(*distance) * air_.metresPerUnit
                          : planes_.last / std::max(shaft.direction.dot(planes_.axis), 1e-6);
  const Mat3d assetFromSun = air_.sunFromAsset.transpose() / air_.metresPerUnit;
  const auto visible = [&](const Vec3d& place) {
    return !rays_.occluded(ray.origin + Vec3((assetFromSun * place).cast<float>()), towardsSun);
  };
  const Eigen::Array3d lit = sky::airBetween(form_, shaft.direction, shaft.length).fromSun;
  const Eigen::Array3d left = by_ == By::Planes
                                  ? sky::shaftsBySplitPlanes(form_, shaft, visible, planes_)
                                  : sky::shaftsByMarch(form_, shaft, visible);
  return (lit - left).cast<float>();
}

}  // namespace lambent::reference
