#include "lambent/sky/picture_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "lambent/image/maps.h"

namespace lambent::sky {

namespace {

constexpr int kLeastSide = 8;

image::MapShape mapOf(const PictureShape& shape) {
  return {shape.map == PictureMap::Cube ? image::MapKind::Cube : image::MapKind::LatLong,
          shape.width, shape.height};
}

/// The circle of a fisheye as the unit disc, y up.
Vec2d inDisc(const PictureShape& shape, const Vec2d& pixel) {
  return {2 * pixel.x() / shape.width - 1, 1 - 2 * pixel.y() / shape.height};
}

/// Also beyond the rim, where it looks below the horizon.
Vec3d fisheyeDirection(const Vec2d& p) {
  const double r = p.norm(), angle = r * kPi / 2;
  const double scale = r > 0 ? std::sin(angle) / r : kPi / 2;
  return {-p.x() * scale, std::cos(angle), -p.y() * scale};
}

Vec3d cameraDirection(const PictureShape& shape, const Vec2d& pixel) {
  const double sinB = std::sin(shape.lookBearing), cosB = std::cos(shape.lookBearing);
  const double sinE = std::sin(shape.lookElevation), cosE = std::cos(shape.lookElevation);
  const Vec3d forward(sinB * cosE, sinE, -cosB * cosE), right(cosB, 0, sinB),
      up(-sinB * sinE, cosE, cosB * sinE);
  const double half = std::tan(shape.verticalFov / 2);
  const double across = half * shape.width / shape.height * (2 * pixel.x() / shape.width - 1);
  const double upwards = half * (1 - 2 * pixel.y() / shape.height);
  return (forward + across * right + upwards * up).normalized();
}

/// Of a triangle between unit vectors (oosterom1983solid).
double triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  // The edges' cross product keeps the digits that a·(b × c) of a small triangle loses.
  const double volume = std::abs(a.dot((b - a).cross(c - a)));
  return 2 * std::atan2(volume, 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

double fisheyeSolidAngle(const PictureShape& shape, int x, int y) {
  // dω = (π/2)² sin θ / θ in units of the disc's radius; three Gauss points each way.
  constexpr std::array<double, 3> kNodes{-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double mean = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double theta =
          kPi / 2 * inDisc(shape, {x + 0.5 + 0.5 * kNodes[i], y + 0.5 + 0.5 * kNodes[j]}).norm();
      mean += kWeights[i] * kWeights[j] * (theta > 1e-9 ? std::sin(theta) / theta : 1.0);
    }
  }
  const double side = kPi / shape.width;
  return side * side * mean;
}

}  // namespace

Status checkShape(const PictureShape& shape) {
  const int w = shape.width, h = shape.height;
  const std::string size = std::to_string(w) + "x" + std::to_string(h);
  const auto refuse = [&](const char* map, const char* sizes) {
    return Status(report::badUsage(std::string(map) + " cannot have " + size +
                                   " pixels: it must be " + sizes));
  };
  if (w < kLeastSide || h < kLeastSide)
    return refuse("a picture of the sky", "at least 8 pixels wide and high");
  switch (shape.map) {
    case PictureMap::LatLong:
      return w == 2 * h ? Status::ok() : refuse("a lat-long map", "twice as wide as high");
    case PictureMap::Fisheye:
      return w == h ? Status::ok() : refuse("a fisheye", "square");
    case PictureMap::Cube:
      return image::checkShape(mapOf(shape))
                 ? Status::ok()
                 : refuse("a cube map", "six squares in a row or column, or a cross of 4x3 or 3x4");
    case PictureMap::Camera:
      break;
  }
  return Status::ok();
}

std::optional<Vec3d> directionOf(const PictureShape& shape, const Vec2d& pixel) {
  switch (shape.map) {
    case PictureMap::Fisheye: {
      const Vec2d p = inDisc(shape, pixel);
      if (p.squaredNorm() > 1) return std::nullopt;
      return fisheyeDirection(p);
    }
    case PictureMap::Camera:
      return cameraDirection(shape, pixel);
    default:
      return image::directionOf(mapOf(shape), pixel);
  }
}

std::optional<Vec3d> directionOfPixel(const PictureShape& shape, int x, int y) {
  const Vec2d centre(x + 0.5, y + 0.5);
  if (shape.map != PictureMap::Fisheye) return directionOf(shape, centre);
  Vec2d p = inDisc(shape, centre);
  if (p.squaredNorm() > 1) {
    const double half = 1.0 / shape.width;
    const Vec2d nearest(std::max(std::abs(p.x()) - half, 0.0),
                        std::max(std::abs(p.y()) - half, 0.0));
    if (nearest.squaredNorm() >= 1) return std::nullopt;
    p *= (1 - 1e-9) / p.norm();  // still above a level horizon
  }
  return fisheyeDirection(p);
}

std::vector<Vec3d> outlineOf(const PictureShape& shape, int x, int y, int perSide) {
  // Just inside, where the border is that of a face whose neighbour in the picture is another.
  constexpr double kInside = 1 - 1e-9;
  const auto at = [&](double a, double b) -> Vec3d {
    const Vec2d pixel(x + 0.5 + a * kInside, y + 0.5 + b * kInside);
    if (shape.map == PictureMap::Fisheye) return fisheyeDirection(inDisc(shape, pixel));
    return directionOf(shape, pixel).value_or(Vec3d::UnitY());
  };
  std::vector<Vec3d> outline;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < perSide; ++i) {
      const double t = double(i) / perSide - 0.5;
      outline.push_back(side == 0   ? at(t, -0.5)
                        : side == 1 ? at(0.5, t)
                        : side == 2 ? at(-t, 0.5)
                                    : at(-0.5, -t));
    }
  }
  return outline;
}

double solidAngleOf(const PictureShape& shape, int x, int y) {
  switch (shape.map) {
    case PictureMap::LatLong: {
      const double middle = kPi * (0.5 - (y + 0.5) / shape.height);
      return 2 * kPi / shape.width * 2 * std::cos(middle) * std::sin(0.5 * kPi / shape.height);
    }
    case PictureMap::Fisheye:
      return fisheyeSolidAngle(shape, x, y);
    default: {  // the borders of pixels are great circles
      const std::vector<Vec3d> corners = outlineOf(shape, x, y, 1);
      return triangle(corners[0], corners[1], corners[2]) +
             triangle(corners[0], corners[2], corners[3]);
    }
  }
}

double pixelRadius(const PictureShape& shape) {
  const double diagonal = std::sqrt(0.5);
  switch (shape.map) {
    case PictureMap::LatLong:
      return diagonal * kPi / shape.height;
    case PictureMap::Fisheye:
      return diagonal * kPi / shape.width;
    case PictureMap::Cube: {
      // A face's side in pixels: image/maps.h has the four ways in which they lie.
      const int w = shape.width, h = shape.height;
      const int n = w == 6 * h ? h : h == 6 * w ? w : w > h ? w / 4 : w / 3;
      return diagonal * 2.0 / n;
    }
    case PictureMap::Camera:
      break;
  }
  return diagonal * 2 * std::tan(shape.verticalFov / 2) / shape.height;
}

}  // namespace lambent::sky
