#include "lambent/view/orbit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lambent::view {

namespace {

constexpr double kPole = 1.0 * kRadiansPerDegree;  // how near the sight may come to `up`
constexpr double kMargin = 0.93;  // of the picture is used, as scene::frameAutomatically

struct Axes {
  Vec3d right, up, back;  // of the camera, in the world
  double distance;
};

Axes axesOf(const LookAt& look) {
  const Vec3d arm = (look.position - look.target).cast<double>();
  Axes axes;
  axes.distance = arm.norm();
  axes.back = arm / axes.distance;
  axes.right = look.up.cast<double>().cross(axes.back).normalized();
  axes.up = axes.back.cross(axes.right);
  return axes;
}

/// Height of the picture in metres, at the target's distance.
double heightAt(const LookAt& look, double distance) {
  return look.orthographicHalfHeight
             ? 2.0 * *look.orthographicHalfHeight
             : 2.0 * distance * std::tan(0.5 * look.verticalFov * kRadiansPerDegree);
}

}  // namespace

LookAt lookAtOf(const scene::Camera& camera, const scene::Box& box) {
  const Eigen::Matrix4d world = camera.worldFromCamera.cast<double>();
  const Vec3d position = world.topRightCorner<3, 1>();
  const Vec3d up = world.block<3, 1>(0, 1).normalized();
  const Vec3d sight = -world.block<3, 1>(0, 2).normalized();
  const double size = box.empty() ? 1.0 : std::max(double(box.diagonal()), 1e-6);
  double distance = box.empty() ? 3.0 : (box.center().cast<double>() - position).dot(sight);
  // A camera that looks away from the object still needs something to turn about.
  distance = std::max(distance, 0.05 * size);
  LookAt look;
  look.position = position.cast<float>();
  look.target = (position + distance * sight).cast<float>();
  // Not rolled: its right lies in the horizontal plane, and it does not stand on its head.
  const Vec3d right = up.cross(-sight);
  const bool level = std::abs(right.y()) < 1e-4 && up.y() > 1e-3;
  look.up = level ? Vec3(Vec3::UnitY()) : Vec3(up.cast<float>());
  look.verticalFov = double(camera.verticalFov) / kRadiansPerDegree;
  if (camera.orthographicHalfHeight)
    look.orthographicHalfHeight = double(*camera.orthographicHalfHeight);
  return look;
}

LookAt orbited(const LookAt& look, double azimuth, double elevation) {
  const Axes axes = axesOf(look);
  const Vec3d pole = look.up.cast<double>().normalized();
  // A camera that starts nearer to the pole than the limit is not thrown back to it: it may stay.
  const double polar = std::acos(std::clamp(axes.back.dot(pole), -1.0, 1.0));
  const double least = std::min(kPole, polar), most = std::max(kPi - kPole, polar);
  const double wanted = std::clamp(polar - elevation, least, most);
  const Vec3d horizontal = axes.right.cross(pole);  // unit: the arm is in the plane of it and pole
  const Vec3d risen = std::cos(wanted) * pole + std::sin(wanted) * horizontal;
  const Vec3d back = Eigen::AngleAxisd(azimuth, pole) * risen;
  LookAt result = look;
  result.position = (look.target.cast<double>() + axes.distance * back).cast<float>();
  return result;
}

LookAt panned(const LookAt& look, const Vec2& shift) {
  const Axes axes = axesOf(look);
  const double height = heightAt(look, axes.distance);
  const Vec3 move =
      (-height * (double(shift.x()) * axes.right + double(shift.y()) * axes.up)).cast<float>();
  LookAt result = look;
  result.position += move;
  result.target += move;
  return result;
}

LookAt zoomed(const LookAt& look, double factor, const Vec2& pointer, double nearest,
              double farthest) {
  const Axes axes = axesOf(look);
  double scale = factor;
  if (!look.orthographicHalfHeight)
    scale = std::clamp(axes.distance * factor, nearest, farthest) / axes.distance;
  const double height = heightAt(look, axes.distance);
  const Vec3d under = look.target.cast<double>() +
                      height * (double(pointer.x()) * axes.right + double(pointer.y()) * axes.up);
  LookAt result = look;
  if (look.orthographicHalfHeight) {
    const double half = std::clamp(*look.orthographicHalfHeight * factor, 0.5 * nearest,
                                   std::max(0.5 * farthest, 0.5 * nearest));
    scale = half / *look.orthographicHalfHeight;
    result.orthographicHalfHeight = half;
    const Vec3d move = (1.0 - scale) * (under - look.target.cast<double>());
    result.position = (look.position.cast<double>() + move).cast<float>();
    result.target = (look.target.cast<double>() + move).cast<float>();
    return result;
  }
  // A scaling of all about the point under the pointer.
  result.position = (under + scale * (look.position.cast<double>() - under)).cast<float>();
  result.target = (under + scale * (look.target.cast<double>() - under)).cast<float>();
  return result;
}

LookAt framed(const LookAt& look, const scene::Box& box, double aspect) {
  if (box.empty()) return look;
  const Axes axes = axesOf(look);
  const Vec3d center = box.center().cast<double>();
  const double ty = kMargin * std::tan(0.5 * look.verticalFov * kRadiansPerDegree);
  const double tx = ty * std::max(aspect, 1e-3);
  const double smallest = std::max(double(box.diagonal()), 1e-6);
  double distance = 0.0, half = 0.0, depth = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p =
        Vec3((corner & 1 ? box.upper : box.lower).x(), (corner & 2 ? box.upper : box.lower).y(),
             (corner & 4 ? box.upper : box.lower).z())
            .cast<double>() -
        center;
    const double x = std::abs(p.dot(axes.right)), y = std::abs(p.dot(axes.up));
    depth = std::max(depth, p.dot(axes.back));
    distance = std::max(distance, p.dot(axes.back) + std::max(x / tx, y / ty));
    half = std::max({half, x / std::max(aspect, 1e-3) / kMargin, y / kMargin});
  }
  LookAt result = look;
  if (look.orthographicHalfHeight) {
    result.orthographicHalfHeight = std::max(half, 1e-6 * smallest);
    distance = depth + smallest;
  }
  distance = std::max(distance, depth + 0.05 * smallest);
  result.target = center.cast<float>();
  result.position = (center + distance * axes.back).cast<float>();
  return result;
}

}  // namespace lambent::view
