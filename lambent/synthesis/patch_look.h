// What a patch looks like from above in a few numbers that can be turned, and in which ways it is
// like itself.
#pragma once

#include <array>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/transfer/rtt.h"

namespace lambent::synthesis {

/// Seen from straight above, over one period, which wraps around.
struct PatchLook {
  int width = 0, height = 0;
  std::vector<Rgb> color;  ///< exit radiance under a white sky of radiance 1, [y][x]
  /// How much brighter it gets by light from +x, and from +y: the luminance of its response to the
  /// harmonics x and y. A slope shows in it.
  std::vector<Vec2> lean;

  /// Bilinear, at the place q (wrapped).
  Rgb colorAt(const Vec2& q) const;
};
/// About as an eye has it: the cube roots of light.
Rgb perceived(const Rgb& color);

PatchLook lookOf(const transfer::Rtt<transfer::Floats>& rtt);

/// A way to lay the patch onto itself: patch(turn(q) + shift) looks like patch(q), seen turned. The
/// turn is by `quarters` right angles counter-clockwise, about the origin.
struct LookSymmetry {
  int quarters = 0;
  Vec2 shift = Vec2::Zero();  ///< in periods, each in [0, 1)
  double likeness = 1.0;      ///< correlation
};

/// Identity first. Quarter turns are looked for where `square` says that the period is as high as
/// wide. Shifts are good to a fraction of a position, or of a 64th of the period.
std::vector<LookSymmetry> symmetriesOf(const PatchLook& look, bool square);

/// `q` turned counter-clockwise.
Vec2 turned(const Vec2& q, int quarters);

}  // namespace lambent::synthesis
