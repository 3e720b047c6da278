// What building a patch of meso-structure yields: how every place of it answers to light, seen from
// every side, before any light is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"
#include "lambent/transfer/numbers.h"

namespace lambent::transfer {

/// The radiance transfer texture B(u, v) (sloan2003biscale §3, §4.2). Exit radiance at the place u
/// of the patch towards v is Σ_i B_i(u, v) · l_i, with l the harmonics of the light that arrives
/// there, in the patch's frame.
///
/// The patch's frame is the tangent frame: +x along the patch's width, +y along its height, +z away
/// from the surface; harmonics have their polar axis along that +z. The patch repeats itself with
/// the period `size` along x and y. Position (x, y) of the grid has its centre at
/// ((x+½)/width, (y+½)/height) · size: row 0 is the lowest, at y = 0.
///
/// Views lie on a grid over the unit square that math::hemisphereFromSquare takes to the
/// hemisphere; view (x, y) has its centre at ((x+½)/views, (y+½)/views). `views` = 1: no dependence
/// on the view.
template <class N>
struct Rtt {
  std::string name;
  int width = 64, height = 64;   ///< positions
  int views = 8;                 ///< a side: views² in all; 1: none
  int bands = 5;                 ///< of the light
  Vec2 size = Vec2(1.0f, 1.0f);  ///< metres: the patch's period along x and y
  float depth = 0.0f;            ///< metres between its lowest and its highest point
  N values;                      ///< [coefficient][y][x][view y][view x][channel]
  /// [y][x][view y][view x]: how high what is seen stands, 0 at the lowest point of the patch and 255
  /// at the highest, so that 127.5 lies in the plane that positions lie in. None: not known.
  std::vector<std::uint8_t> heights;

  std::size_t positionCount() const { return std::size_t(width) * std::size_t(height); }
  std::size_t viewCount() const { return std::size_t(views) * std::size_t(views); }
  std::size_t coefficientCount() const { return std::size_t(sh::coefficientCount(bands)); }
  /// Numbers of one coefficient. Snorm8 has one scale for each.
  std::size_t planeSize() const { return positionCount() * viewCount() * 3; }
  std::size_t index(int coefficient, int x, int y, int viewX, int viewY) const {
    return coefficient * planeSize() +
           (((std::size_t(y) * width + x) * views + viewY) * views + viewX) * 3;
  }
};

}  // namespace lambent::transfer
