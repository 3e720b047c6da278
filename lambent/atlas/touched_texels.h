// The texels that a segment or a triangle touches, were it by a corner alone. Texel (x, y) is the
// square [x, x+1] × [y, y+1]; coordinates are in texels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "lambent/math/types.h"

namespace lambent::atlas {

/// visit(y, x0, x1) for every row of texels that the segments a–b–c–… touch (closed if three or
/// more), from the first column to the last between which the row's part of the convex hull lies.
/// With `margin`, all within it count as touched too; a negative one leaves out what is touched by
/// no more than that.
template <std::size_t N, class Visit>
void forTouchedRows(const Vec2d (&p)[N], double margin, const Visit& visit) {
  double low = p[0].y(), high = p[0].y();
  for (const Vec2d& q : p) low = std::min(low, q.y()), high = std::max(high, q.y());
  const int y0 = static_cast<int>(std::floor(low - margin));
  const int y1 = std::max(y0, static_cast<int>(std::floor(high + margin)));
  for (int y = y0; y <= y1; ++y) {
    const double bottom = std::min(std::max(low, y - margin), high);
    const double top = std::max(std::min(high, y + 1 + margin), low);
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t i = 0; i < (N == 2 ? 1 : N); ++i) {
      const Vec2d &a = p[i], &b = p[(i + 1) % N];
      const double lower = std::min(a.y(), b.y()), upper = std::max(a.y(), b.y());
      if (upper < bottom || lower > top) continue;
      for (const double at : {std::max(bottom, lower), std::min(top, upper)}) {
        const double share = upper > lower ? (at - a.y()) / (b.y() - a.y()) : 0.0;
        const double x = a.x() + std::clamp(share, 0.0, 1.0) * (b.x() - a.x());
        left = std::min(left, x), right = std::max(right, x);
      }
      if (upper == lower)
        left = std::min({left, a.x(), b.x()}), right = std::max({right, a.x(), b.x()});
    }
    if (!(left <= right)) continue;
    const int x0 = static_cast<int>(std::floor(left - margin));
    visit(y, x0, std::max(x0, static_cast<int>(std::floor(right + margin))));
  }
}

}  // namespace lambent::atlas
