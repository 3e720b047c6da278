#include "lambent/transport/inside_probe.h"

#include <algorithm>
#include <iterator>

#include <Eigen/Geometry>

#include "lambent/math/random.h"

namespace lambent::transport {

namespace {

constexpr double kMostBacks = 1.0 / 3.0;
/// Of some 12 rays.
constexpr double kSurelyNot = 0.1, kSurely = 0.75;

}  // namespace

InsideProbe::InsideProbe(const trace::RayScene& rays)
    : rays_(rays), few_(24, math::randomRotation(1)), many_(512, math::randomRotation(2)) {}

/// Along the normal and, leaning by 60° from it, to three sides.
bool InsideProbe::meetsBack(const Vec3& origin, const Vec3& normal) const {
  const Vec3 right = normal.unitOrthogonal(), ahead = normal.cross(right);
  const float half = 0.5f, root = 0.866025404f;
  const Vec3 ways[] = {normal, half * normal + root * right,
                       half * normal + root * (-half * right + root * ahead),
                       half * normal + root * (-half * right - root * ahead)};
  return std::any_of(std::begin(ways), std::end(ways), [&](const Vec3& way) {
    const auto hit = rays_.closest(origin, way);
    return hit && hit->backFace;
  });
}

double InsideProbe::shareOfBacks(const trace::DirectionSet& directions, const Vec3& origin,
                                 const Vec3& normal, trace::CastResult& scratch) const {
  trace::castClosest(rays_, directions, origin, normal, scratch);
  const auto backs = std::count_if(scratch.hits.begin(), scratch.hits.end(),
                                   [](const trace::DirectionHit& hit) { return hit.backFace; });
  return static_cast<double>(backs) /
         static_cast<double>(std::max<std::size_t>(scratch.raysCast, 1));
}

bool InsideProbe::seesBacks(const Vec3& origin, const Vec3& normal,
                            trace::CastResult& scratch) const {
  if (!meetsBack(origin, normal)) return false;
  const double share = shareOfBacks(few_, origin, normal, scratch);
  if (share < kSurelyNot || share > kSurely) return share > kSurely;
  return shareOfBacks(many_, origin, normal, scratch) > kMostBacks;
}

}  // namespace lambent::transport
