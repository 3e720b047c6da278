// Based on: meisters1975polygons, the two-ears theorem. A corner is an ear if it is convex and no
// other corner lies in its triangle; cutting it leaves a polygon with one corner less.
#include "lambent/scene_io/polygon.h"

#include <Eigen/Geometry>

namespace lambent::scene_io {
namespace {

using Vec2d = Eigen::Vector2d;

constexpr std::size_t kMostEarCorners = 64;

double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool inside(const Vec2d& p, const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

/// The corners in a plane of their own, turning counter-clockwise; empty if they have no area.
std::vector<Vec2d> flatten(std::span<const Vec3d> corners) {
  Vec3d normal = Vec3d::Zero();  // Newell's: twice the area, along the polygon's mean normal
  const Vec3d origin = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i] - origin;
    const Vec3d b = corners[(i + 1) % corners.size()] - origin;
    normal += a.cross(b);
  }
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  normal /= length;
  const Vec3d x = normal.unitOrthogonal(), y = normal.cross(x);
  std::vector<Vec2d> flat;
  for (const Vec3d& corner : corners) {
    const Vec3d p = corner - origin;
    flat.emplace_back(p.dot(x), p.dot(y));
  }
  return flat;
}

}  // namespace

void cutPolygon(std::span<const Vec3d> corners, std::vector<scene::Triangle>& triangles) {
  const auto count = std::uint32_t(corners.size());
  const auto fan = [&] {
    for (std::uint32_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
  };
  if (count <= 3 || count > kMostEarCorners) return fan();
  const std::vector<Vec2d> flat = flatten(corners);
  if (flat.empty()) return fan();

  std::vector<std::uint32_t> left(count);
  for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
      if (!(cross(flat[b] - flat[a], flat[c] - flat[b]) > 0.0)) continue;
      bool isEar = true;
      for (std::size_t j = 0; j < n && isEar; ++j) {
        const std::uint32_t p = left[j];
        if (p == a || p == b || p == c || flat[p] == flat[a] || flat[p] == flat[b] ||
            flat[p] == flat[c]) {
          continue;
        }
        isEar = !inside(flat[p], flat[a], flat[b], flat[c]);
      }
      if (isEar) ear = i;
    }
    if (ear == n) ear = 0;  // crossing itself: any cut is as good
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + std::ptrdiff_t(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
}

}  // namespace lambent::scene_io
