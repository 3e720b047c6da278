// Light by formula. Edges are soft over a pixel or more, so that the maps are small and what
// mirrors show of them has no steps.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lambent/image/maps.h"
#include "lambent/math/directions.h"
#include "web/viewer/assets/scenes.h"

namespace lambent::page {
namespace {

double smooth(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A lit panel: how much of it is seen in a direction. `towards` is its middle.
struct Panel {
  Vec3d towards;
  double width, height;  ///< tangents of the half angles
  double softness;
  Vec3d color;

  Vec3d radiance(const Vec3d& s) const {
    const Vec3d n = towards.normalized();
    const double along = s.dot(n);
    if (along <= 0) return Vec3d::Zero();
    const Vec3d right = Vec3d::UnitY().cross(n).normalized(), up = n.cross(right);
    const double x = std::abs(s.dot(right) / along), y = std::abs(s.dot(up) / along);
    const double inside = smooth(width + softness, width - softness, x) *
                          smooth(height + softness, height - softness, y);
    // A softbox is brighter in the middle.
    const double falloff = 1 - 0.35 * (x * x / (width * width) + y * y / (height * height)) / 2;
    return inside * falloff * color;
  }
};

template <class Radiance>
image::Image map(int height, const Radiance& radiance) {
  image::Image image(2 * height, height);
  const image::MapShape shape{image::MapKind::LatLong, image.width, image.height};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = radiance(*image::directionOf(shape, {x + 0.5, y + 0.5}))
                           .template cast<float>()
                           .array()
                           .max(0.0f);
  return image;
}

Vec3d aimed(double azimuth, double elevation) {
  return math::directionFromAzimuthElevation(azimuth * kPi / 180, elevation * kPi / 180);
}

}  // namespace

image::Image studioLight() {
  const Panel panels[] = {
      {aimed(158, 33), 0.62, 0.50, 0.06, Vec3d(9.5, 7.4, 5.2)},   // key: warm, from the left
      {aimed(-8, 20), 0.22, 0.80, 0.05, Vec3d(1.3, 1.9, 2.9)},    // fill: a cool strip, right
      {aimed(-100, 38), 0.80, 0.22, 0.05, Vec3d(2.2, 2.3, 2.6)},  // rim: behind
  };
  return map(256, [&](const Vec3d& s) -> Vec3d {
    // A dark cyclorama, a little brighter towards the horizon.
    const double glow = std::exp(-std::pow((s.y() - 0.02) / 0.30, 2));
    Vec3d sum = Vec3d(0.030, 0.033, 0.038) + glow * Vec3d(0.060, 0.062, 0.068);
    if (s.y() < 0) sum *= 1 + 0.5 * s.y();
    for (const Panel& panel : panels) sum += panel.radiance(s);
    return sum;
  });
}

image::Image eveningSky() {
  const Vec3d sun = aimed(140, 24);
  return map(256, [&](const Vec3d& s) -> Vec3d {
    const double up = std::max(s.y(), 0.0), towards = std::max(s.dot(sun), 0.0);
    const double haze = std::exp(-up / 0.16);
    const Vec3d zenith(0.10, 0.19, 0.42), horizon(0.95, 0.62, 0.40), away(0.42, 0.44, 0.58);
    const double side =
        0.5 +
        0.5 * Vec3d(s.x(), 0, s.z()).normalized().dot(Vec3d(sun.x(), 0, sun.z()).normalized());
    Vec3d sky = zenith + haze * (side * horizon + (1 - side) * away);
    sky += Vec3d(1.9, 1.05, 0.45) * std::pow(towards, 8) * 0.6;
    sky += Vec3d(6.0, 3.6, 1.7) * std::pow(towards, 90);
    const double angle = std::acos(std::clamp(s.dot(sun), -1.0, 1.0)) * 180 / kPi;
    sky += Vec3d(190, 128, 70) * smooth(3.2, 2.2, angle);
    // The ground fades into the haze before the horizon.
    const double near = 1 - std::exp(std::min(s.y(), 0.0) / 0.22);
    const Vec3d plain = Vec3d(0.10, 0.085, 0.075) + 0.10 * side * Vec3d(0.9, 0.6, 0.4);
    const Vec3d ground = plain + (1 - near) * (Vec3d(0.42, 0.33, 0.30) - plain);
    return sky + smooth(0.012, -0.012, s.y()) * (ground - sky);
  });
}

}  // namespace lambent::page
