#include "lambent/macro/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"

namespace lambent::macro {

namespace {

/// All triangles of some meshes, to be drawn by area or by number.
class TriangleDraw {
 public:
  template <class Wanted>
  TriangleDraw(const scene::Scene& scene, const Wanted& wanted) {
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      if (!wanted(m)) continue;
      const scene::Mesh& mesh = scene.meshes[m];
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const scene::Triangle& c = mesh.triangles[t];
        const Vec3d a = mesh.positions[c[0]].cast<double>();
        const double area = 0.5 * (mesh.positions[c[1]].cast<double>() - a)
                                      .cross(mesh.positions[c[2]].cast<double>() - a)
                                      .norm();
        if (!(area > 0.0)) continue;
        area_ += area;
        triangles_.push_back({m, t}), areaUpTo_.push_back(area_);
      }
    }
  }
  bool empty() const { return triangles_.empty(); }

  trace::RayScene::GlobalTriangle byArea(double fraction) const {
    const auto after = std::upper_bound(areaUpTo_.begin(), areaUpTo_.end(), fraction * area_);
    return triangles_[std::min<std::size_t>(std::size_t(after - areaUpTo_.begin()),
                                            triangles_.size() - 1)];
  }
  trace::RayScene::GlobalTriangle byNumber(double fraction) const {
    return triangles_[std::min(static_cast<std::size_t>(fraction * double(triangles_.size())),
                               triangles_.size() - 1)];
  }

 private:
  std::vector<trace::RayScene::GlobalTriangle> triangles_;
  std::vector<double> areaUpTo_;
  double area_ = 0.0;
};

/// The unit square onto the triangle, area for area.
Vec2 barycentricOf(const Vec2& square) {
  const bool over = square.x() + square.y() > 1.0f;
  return over ? Vec2(Vec2::Ones() - square) : square;
}

}  // namespace

SurfaceSamples drawSamples(const scene::Scene& scene, const trace::RayScene& rays,
                           const std::vector<bool>& isLookedAt, std::size_t count,
                           std::uint64_t seed) {
  const auto isSeen = [&](std::uint32_t m) { return bool(isLookedAt[m]); };
  SurfaceSamples drawn;
  const TriangleDraw seen(scene, isSeen), all(scene, [](std::uint32_t) { return true; });
  if (seen.empty()) return drawn;
  const std::size_t half = std::max<std::size_t>(count / 2, 1);
  math::Random random(seed, 0x73616d70);
  const double start = random.uniformDouble();
  const Vec2 shift = random.uniform2();
  const auto fractionOf = [&](std::size_t k) { return (double(k) + start) / double(half); };
  for (std::size_t k = 0; k < half; ++k) {
    const auto [mesh, triangle] = seen.byArea(fractionOf(k));
    const Vec2 at = barycentricOf(math::r2(static_cast<std::uint32_t>(k), shift));
    drawn.samples.push_back({mesh, triangle, at.x(), at.y()});
  }
  std::vector<float> distances;
  for (std::size_t k = 0; k < half; ++k) {
    const auto from = k % 2 == 0 ? all.byArea(fractionOf(k)) : all.byNumber(fractionOf(k));
    math::Random own(seed, 0x72617973, k);
    const Vec2 at = barycentricOf(own.uniform2()), aim = own.uniform2();
    const scene::SurfacePoint point =
        scene::surfaceAt(scene, from.mesh, from.triangle, at.x(), at.y());
    const Vec3 direction =
        math::worldFromTangent(point.geometricNormal) * math::cosineHemisphere(aim);
    const auto hit =
        rays.closest(point.position + rays.offset() * point.geometricNormal, direction);
    if (!hit || hit->backFace || !isSeen(hit->mesh)) continue;
    drawn.samples.push_back({hit->mesh, hit->triangle, hit->u, hit->v});
    distances.push_back(hit->distance);
  }
  if (!distances.empty()) {
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    drawn.feature = *middle;
  }
  return drawn;
}

}  // namespace lambent::macro
