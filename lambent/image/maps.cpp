// Geometry of environment maps: ramamoorthi2001efficient Figure 3 and debevec1998rendering for the
// angular map; the cube's faces are those of the OpenGL specification (table "Selection of cube map
// images").
#include "lambent/image/maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/math/directions.h"

namespace lambent::image {
namespace {

// How the faces of a cube lie in a picture, in cells of n × n pixels.
struct CubeLayout {
  int n = 0;
  struct Cell {
    int x, y;
    bool turned;  ///< by 180°: −z below −y in the standing cross
  };
  std::array<Cell, 6> cells{};
};

CubeLayout layoutOf(int width, int height) {
  CubeLayout layout;
  if (width == 6 * height) {
    layout.n = height;
    for (int f = 0; f < 6; ++f) layout.cells[f] = {f, 0, false};
  } else if (height == 6 * width) {
    layout.n = width;
    for (int f = 0; f < 6; ++f) layout.cells[f] = {0, f, false};
  } else if (width * 3 == height * 4 && width % 4 == 0) {
    layout.n = width / 4;
    layout.cells = {
        {{2, 1, false}, {0, 1, false}, {1, 0, false}, {1, 2, false}, {1, 1, false}, {3, 1, false}}};
  } else if (width * 4 == height * 3 && width % 3 == 0) {
    layout.n = width / 3;
    layout.cells = {
        {{2, 1, false}, {0, 1, false}, {1, 0, false}, {1, 2, false}, {1, 1, false}, {1, 3, true}}};
  }
  return layout;
}

/// a to the right and b downwards in the face, −1 … 1 on the face itself.
Vec3d cubeVector(int face, double a, double b) {
  switch (face) {
    case 0:
      return {1, -b, -a};
    case 1:
      return {-1, -b, a};
    case 2:
      return {a, 1, b};
    case 3:
      return {a, -1, -b};
    case 4:
      return {a, -b, 1};
    default:
      return {-a, -b, -1};
  }
}

struct FacePoint {
  int face;
  double a, b;
};

FacePoint facePointOf(const Vec3d& d) {
  const double x = std::abs(d.x()), y = std::abs(d.y()), z = std::abs(d.z());
  if (x >= y && x >= z) {
    return d.x() > 0 ? FacePoint{0, -d.z() / x, -d.y() / x} : FacePoint{1, d.z() / x, -d.y() / x};
  }
  if (y >= z) {
    return d.y() > 0 ? FacePoint{2, d.x() / y, d.z() / y} : FacePoint{3, d.x() / y, -d.z() / y};
  }
  return d.z() > 0 ? FacePoint{4, d.x() / z, -d.y() / z} : FacePoint{5, -d.x() / z, -d.y() / z};
}

Vec2d pixelInLayout(const CubeLayout& layout, const FacePoint& p) {
  const CubeLayout::Cell& cell = layout.cells[p.face];
  const double a = cell.turned ? -p.a : p.a, b = cell.turned ? -p.b : p.b;
  return {layout.n * (cell.x + 0.5 * (a + 1)), layout.n * (cell.y + 0.5 * (b + 1))};
}

/// Which face's cell holds a pixel position, or −1: an empty cell of a cross.
int faceAt(const CubeLayout& layout, const Vec2d& pixel) {
  for (int f = 0; f < 6; ++f) {
    const CubeLayout::Cell& cell = layout.cells[f];
    if (pixel.x() >= cell.x * layout.n && pixel.x() <= (cell.x + 1) * layout.n &&
        pixel.y() >= cell.y * layout.n && pixel.y() <= (cell.y + 1) * layout.n) {
      return f;
    }
  }
  return -1;
}

/// Position within a face (also beyond its rim) of a pixel position.
Vec2d pointInFace(const CubeLayout& layout, int face, const Vec2d& pixel) {
  const CubeLayout::Cell& cell = layout.cells[face];
  const Vec2d p(2 * (pixel.x() / layout.n - cell.x) - 1, 2 * (pixel.y() / layout.n - cell.y) - 1);
  return cell.turned ? Vec2d(-p) : p;
}

Vec3d latLongDirection(const MapShape& shape, const Vec2d& pixel) {
  const double azimuth = 2 * kPi * (pixel.x() / shape.width - 0.5);
  const double elevation = kPi * (0.5 - pixel.y() / shape.height);
  return math::directionFromAzimuthElevation(azimuth, elevation);
}

/// The disc of a round map as [−1, 1]², y upwards.
Vec2d discPoint(const MapShape& shape, const Vec2d& pixel) {
  return {2 * pixel.x() / shape.width - 1, 1 - 2 * pixel.y() / shape.height};
}

double angleAtRadius(MapKind kind, double r) {
  return kind == MapKind::Angular ? kPi * r : 2 * std::asin(std::min(r, 1.0));
}

Vec3d roundDirection(MapKind kind, const Vec2d& p) {
  const double r = p.norm();
  if (r == 0) return Vec3d::UnitZ();
  const double angle = angleAtRadius(kind, r);
  return {std::sin(angle) * p.x() / r, std::sin(angle) * p.y() / r, std::cos(angle)};
}

Rgb pixelAt(const Image& image, const Vec2d& pixel) {
  const int x = std::clamp(static_cast<int>(std::floor(pixel.x())), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(std::floor(pixel.y())), 0, image.height - 1);
  return image.at(x, y);
}

// One of the four pixels around a sampling position. Where it lies outside of the map, the map is
// continued: over the pole or the rim, or onto the next face.
Rgb tap(const Image& image, const MapShape& shape, const CubeLayout& layout, int face, int x,
        int y) {
  if (shape.kind == MapKind::LatLong) {
    if (y < 0 || y >= shape.height) {
      y = y < 0 ? -1 - y : 2 * shape.height - 1 - y;
      x += shape.width / 2;
    }
    x %= shape.width;
    return image.at(x < 0 ? x + shape.width : x, y);
  }
  const Vec2d centre(x + 0.5, y + 0.5);
  if (shape.kind == MapKind::Cube) {
    const Vec2d p = pointInFace(layout, face, centre);
    if (std::abs(p.x()) <= 1 && std::abs(p.y()) <= 1) return image.at(x, y);
    return pixelAt(image, pixelOf(shape, cubeVector(face, p.x(), p.y())));
  }
  const Vec2d p = discPoint(shape, centre);
  if (p.squaredNorm() <= 1) return image.at(x, y);
  // Beyond the rim: the angular map goes on past −z and comes back on the other side; the ball's
  // does not, and its rim is repeated. A little further in, lest the pixel found be one whose
  // centre lies outside.
  const double inner = 1 - 1.5 / shape.width;
  const double r = p.norm();
  Vec2d inside = p * (inner / r);
  if (shape.kind == MapKind::Angular && r < 2) inside = -p / r * std::min(2 - r, inner);
  return pixelAt(image,
                 {0.5 * shape.width * (inside.x() + 1), 0.5 * shape.height * (1 - inside.y())});
}

}  // namespace

Status checkShape(const MapShape& shape) {
  const int w = shape.width, h = shape.height;
  const auto refuse = [&](const char* kind, const char* sizes) {
    return Status(report::badInput(std::string(kind) + " cannot have " + std::to_string(w) + "×" +
                                   std::to_string(h) + " pixels; it must be " + sizes));
  };
  if (w <= 0 || h <= 0) return refuse("an environment map", "larger");
  switch (shape.kind) {
    case MapKind::LatLong:
      // With an odd width nothing lies exactly opposite, across the pole; half a pixel is no
      // matter.
      return Status::ok();
    case MapKind::Cube:
      if (w > (1 << 20) || h > (1 << 20) || layoutOf(w, h).n == 0) {
        return refuse("a cube map", "six squares in a row or column, or a cross of 4×3 or 3×4");
      }
      return Status::ok();
    case MapKind::Angular:
      return w == h ? Status::ok() : refuse("an angular map", "square");
    case MapKind::MirrorBall:
      return w == h ? Status::ok() : refuse("the map of a mirrored ball", "square");
  }
  return Status::ok();
}

std::optional<MapKind> guessKind(int width, int height) {
  if (width <= 0 || height <= 0) return std::nullopt;
  if (width == 2 * height) return MapKind::LatLong;
  if (width == height) return MapKind::Angular;
  if (checkShape({MapKind::Cube, width, height})) return MapKind::Cube;
  return std::nullopt;
}

std::optional<Vec3d> directionOf(const MapShape& shape, const Vec2d& pixel) {
  switch (shape.kind) {
    case MapKind::LatLong:
      return latLongDirection(shape, pixel);
    case MapKind::Cube: {
      const CubeLayout layout = layoutOf(shape.width, shape.height);
      const int face = faceAt(layout, pixel);
      if (face < 0) return std::nullopt;
      const Vec2d p = pointInFace(layout, face, pixel);
      return cubeVector(face, p.x(), p.y()).normalized();
    }
    default: {
      const Vec2d p = discPoint(shape, pixel);
      if (p.squaredNorm() > 1) return std::nullopt;
      return roundDirection(shape.kind, p);
    }
  }
}

Vec2d pixelOf(const MapShape& shape, const Vec3d& direction) {
  assert(direction.squaredNorm() > 0);
  switch (shape.kind) {
    case MapKind::LatLong: {
      const auto [azimuth, elevation] = math::azimuthElevationOf(direction);
      return {(azimuth / (2 * kPi) + 0.5) * shape.width, (0.5 - elevation / kPi) * shape.height};
    }
    case MapKind::Cube:
      return pixelInLayout(layoutOf(shape.width, shape.height), facePointOf(direction));
    default: {
      const double across = std::hypot(direction.x(), direction.y());
      const double angle = std::atan2(across, direction.z());
      const double r = shape.kind == MapKind::Angular ? angle / kPi : std::sin(0.5 * angle);
      const Vec2d p =
          across > 0 ? Vec2d(direction.x() * r / across, direction.y() * r / across) : Vec2d(r, 0);
      return {0.5 * shape.width * (p.x() + 1), 0.5 * shape.height * (1 - p.y())};
    }
  }
}

Rgb sample(const Image& image, MapKind kind, const Vec3d& direction) {
  const MapShape shape{kind, image.width, image.height};
  const CubeLayout layout =
      kind == MapKind::Cube ? layoutOf(image.width, image.height) : CubeLayout{};
  const int face = kind == MapKind::Cube ? facePointOf(direction).face : 0;
  const Vec2d p = pixelOf(shape, direction) - Vec2d(0.5, 0.5);
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
  const auto fx = static_cast<float>(p.x() - x), fy = static_cast<float>(p.y() - y);
  const Rgb top = tap(image, shape, layout, face, x, y) * (1 - fx) +
                  tap(image, shape, layout, face, x + 1, y) * fx;
  const Rgb bottom = tap(image, shape, layout, face, x, y + 1) * (1 - fx) +
                     tap(image, shape, layout, face, x + 1, y + 1) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace lambent::image
