// Where a pixel of a picture of the sky looks, in the world: +y up, north −z, east +x. Pixel
// coordinates are continuous, as in image/maps.h: pixel (i, j) covers [i, i+1) × [j, j+1), y grows
// downwards.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::sky {

enum class PictureMap {
  LatLong,  ///< image::MapKind::LatLong, twice as wide as high: north (−z) at a quarter of the width
  /// What a camera sees that lies on its back: equidistant, the zenith in the centre, the horizon
  /// (elevation 0) at the rim of the inscribed circle; north is up and *east left*. Square.
  Fisheye,
  Cube,    ///< image::MapKind::Cube: faces in a row, a column or a cross
  Camera,  ///< rectilinear, level, any size
};

struct PictureShape {
  PictureMap map = PictureMap::LatLong;
  int width = 2048, height = 1024;
  // Of Camera, rad:
  double lookBearing = 0;  ///< compass bearing of the centre: north 0, east π/2
  double lookElevation = 0;
  double verticalFov = kPi / 3;  ///< above 0, below π
};

/// BadUsage: the size is none that the map has, or a side is below 8 pixels.
Status checkShape(const PictureShape& shape);

/// The unit direction in the world; nothing outside of the map (corners of a fisheye, empty cells of
/// a cross).
std::optional<Vec3d> directionOf(const PictureShape& shape, const Vec2d& pixel);
/// Of the centre of a pixel. A pixel of which any part lies in the map looks somewhere: of one whose
/// centre is just outside of a fisheye's rim it is the nearest point of the rim.
std::optional<Vec3d> directionOfPixel(const PictureShape& shape, int x, int y);

/// The border of a pixel, once around, in directions of the world: `perSide` on each side.
std::vector<Vec3d> outlineOf(const PictureShape& shape, int x, int y, int perSide);
/// sr. LatLong, Cube and Camera are closed forms, Fisheye is good to 1e-9.
double solidAngleOf(const PictureShape& shape, int x, int y);
/// No point of a pixel is farther from its centre than this angle, rad.
double pixelRadius(const PictureShape& shape);

}  // namespace lambent::sky
