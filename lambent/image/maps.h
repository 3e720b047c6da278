// Pictures of all directions: where a pixel looks, which pixel a direction falls in, and how large
// a pixel is on the sphere. Pixel coordinates are continuous: pixel (i, j) covers [i, i+1) × [j,
// j+1), its centre is (i+½, j+½), y grows downwards.
#pragma once

#include <optional>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::image {

enum class MapKind {
  /// u = atan2(z, x)/2π + ½, elevation asin(y) = π(½ − v), v from the top. Any size.
  LatLong,
  /// Six square faces in OpenGL's sequence and orientation (+x, −x, +y, −y, +z, −z). The picture's
  /// shape says how they lie: a column (n × 6n) or row (6n × n) in that sequence; a cross lying
  /// (4n × 3n) or standing (3n × 4n), with +z in the centre of the cross, +y above it, −y below.
  Cube,
  /// Light probe: the centre is +z, the rim of the inscribed circle is −z, the angle to +z is
  /// proportional to the radius; right is +x, up is +y (ramamoorthi2001efficient Figure 3,
  /// debevec1998rendering). Square.
  Angular,
  /// Photograph of a mirrored ball from far along +z: as Angular, but the radius is sin(angle/2).
  /// Square.
  MirrorBall,
};

struct MapShape {
  MapKind kind = MapKind::LatLong;
  int width = 0, height = 0;
};

/// Whether the size fits the kind; a BadInput that says which sizes would.
Status checkShape(const MapShape& shape);
/// LatLong for 2:1, Angular for 1:1, Cube for the shapes above; nothing for others.
std::optional<MapKind> guessKind(int width, int height);

/// The unit direction at continuous pixel coordinates; nothing outside of the map (the corners of
/// an Angular map, the empty cells of a cross).
std::optional<Vec3d> directionOf(const MapShape& shape, const Vec2d& pixel);
/// The continuous pixel coordinates of a direction of any length but zero.
Vec2d pixelOf(const MapShape& shape, const Vec3d& direction);

/// Solid angle of every pixel (sr), row after row: that of the part of it which lies in the map.
/// They sum to 4π. LatLong and Cube are closed forms; Angular and MirrorBall are line integrals
/// along the pixel's edges, good to 1e-12.
std::vector<double> solidAngles(const MapShape& shape);

/// Bilinear between pixel centres, continuous across the seam, the poles, the edges of the cube and
/// the rim. Thread-safe.
Rgb sample(const Image& image, MapKind kind, const Vec3d& direction);

/// The same light in another map: every target pixel is the mean of bilinear samples on a grid
/// that is fine enough for the source's pixels. Pixels outside of the map are black. Asserts on a
/// shape that checkShape refuses.
Image resample(const Image& source, MapKind sourceKind, const MapShape& target);

}  // namespace lambent::image
