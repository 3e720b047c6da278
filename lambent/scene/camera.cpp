#include "lambent/scene/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace lambent::scene {
namespace {

using Mat4d = Eigen::Matrix4d;

/// Half the image's extent at distance 1 (perspective) or at any distance (orthographic).
struct HalfExtent {
  double x, y;
};

HalfExtent halfExtent(const Camera& camera, double aspect) {
  const double y = camera.orthographicHalfHeight ? double(*camera.orthographicHalfHeight)
                                                 : std::tan(0.5 * double(camera.verticalFov));
  return {y * aspect, y};
}

}  // namespace

Ray cameraRay(const Camera& camera, int width, int height, float x, float y) {
  assert(width > 0 && height > 0);
  const HalfExtent half = halfExtent(camera, double(width) / height);
  const double px = (2.0 * double(x) / width - 1.0) * half.x;
  const double py = (1.0 - 2.0 * double(y) / height) * half.y;
  const Mat4d world = camera.worldFromCamera.cast<double>();
  const Mat3d linear = world.topLeftCorner<3, 3>();
  const Vec3d translation = world.topRightCorner<3, 1>();
  Vec3d origin = translation, direction;
  if (camera.orthographicHalfHeight) {
    origin += linear * Vec3d(px, py, 0.0);
    direction = -linear.col(2);
  } else {
    direction = linear * Vec3d(px, py, -1.0);
  }
  return {origin.cast<float>(), direction.normalized().cast<float>()};
}

Mat4 clipFromWorld(const Camera& camera, int width, int height, const Box& box) {
  assert(width > 0 && height > 0);
  const Mat4d cameraFromWorld = camera.worldFromCamera.cast<double>().inverse();

  // Depths of the box along the view, with a margin so that nothing lies on a clipping plane.
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const Vec3d p((corner & 1 ? box.upper : box.lower).x(),
                  (corner & 2 ? box.upper : box.lower).y(),
                  (corner & 4 ? box.upper : box.lower).z());
    const double depth = -(cameraFromWorld * p.homogeneous()).z();
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (!(nearest <= farthest)) nearest = 0.0, farthest = 1.0;
  const double margin = 0.01 * (farthest - nearest) + 1e-4 * std::abs(farthest) + 1e-9;
  double zNear = nearest - margin, zFar = farthest + margin;

  const HalfExtent half = halfExtent(camera, double(width) / height);
  Mat4d projection = Mat4d::Zero();
  projection(0, 0) = 1.0 / half.x;
  projection(1, 1) = 1.0 / half.y;
  if (camera.orthographicHalfHeight) {
    projection(2, 2) = -2.0 / (zFar - zNear);
    projection(2, 3) = -(zFar + zNear) / (zFar - zNear);
    projection(3, 3) = 1.0;
  } else {
    // A camera inside the box, or before all of it: the near plane keeps a 24-bit depth buffer
    // useful at 1 : 10⁴.
    if (zFar <= 0.0) zFar = 1.0;
    zNear = std::max(zNear, 1e-4 * zFar);
    projection(2, 2) = -(zFar + zNear) / (zFar - zNear);
    projection(2, 3) = -2.0 * zFar * zNear / (zFar - zNear);
    projection(3, 2) = -1.0;
  }
  const Mat4d result = projection * cameraFromWorld;
  return result.cast<float>();
}

Camera frameAutomatically(const Scene& scene, float aspect) {
  Camera camera;
  camera.name = "automatic";
  camera.verticalFov = 0.6f;
  const Vec3d back = Vec3d(0.55, 0.45, 1.0).normalized();
  const Vec3d right = Vec3d::UnitY().cross(back).normalized();
  const Vec3d up = back.cross(right);
  const double margin = 0.93;  // of the image is used, so that nothing touches its border
  const HalfExtent half = halfExtent(camera, std::max(double(aspect), 1e-3));
  const double tx = margin * half.x, ty = margin * half.y;

  // Each side plane of the view pyramid must have every vertex on its inner side. With the axes
  // fixed these are linear in the eye's position, so the nearest eye is found in one pass.
  const double none = -std::numeric_limits<double>::infinity();
  double rightmost = none, leftmost = none, topmost = none, lowest = none, foremost = none;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& position : mesh.positions) {
      const Vec3d p = position.cast<double>();
      const double a = p.dot(right), b = p.dot(up), d = p.dot(back);
      rightmost = std::max(rightmost, a + tx * d);
      leftmost = std::max(leftmost, -a + tx * d);
      topmost = std::max(topmost, b + ty * d);
      lowest = std::max(lowest, -b + ty * d);
      foremost = std::max(foremost, d);
    }
  }
  Vec3d eye = 3.0 * back;
  if (std::isfinite(foremost)) {
    const double diagonal = std::max(double(bounds(scene).diagonal()), 1e-6);
    double distance = std::max(0.5 * (rightmost + leftmost) / tx, 0.5 * (topmost + lowest) / ty);
    distance = std::max(distance, foremost + 0.05 * diagonal);
    eye = 0.5 * (rightmost - leftmost) * right + 0.5 * (topmost - lowest) * up + distance * back;
  }
  Mat4d world = Mat4d::Identity();
  world.topLeftCorner<3, 3>() << right, up, back;
  world.topRightCorner<3, 1>() = eye;
  camera.worldFromCamera = world.cast<float>();
  return camera;
}

std::vector<Vec2> subpixelPositions(int count) {
  // Hammersley points, with the radical inverse replaced by its rank so that both coordinates are
  // evenly stratified and average to the pixel's centre for every count.
  count = std::max(count, 1);
  std::vector<std::uint32_t> reversed(count);
  for (int i = 0; i < count; ++i) {
    std::uint32_t bits = 0;
    for (int b = 0; b < 32; ++b) bits |= (std::uint32_t(i) >> b & 1u) << (31 - b);
    reversed[i] = bits;
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return reversed[a] < reversed[b]; });
  std::vector<Vec2> positions(count);
  for (int rank = 0; rank < count; ++rank) {
    const int i = order[rank];
    positions[i] = Vec2((float(i) + 0.5f) / float(count), (float(rank) + 0.5f) / float(count));
  }
  return positions;
}

}  // namespace lambent::scene
