#include "lambent/scene_io/far_origin.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lambent::scene_io {

Vec3d farOrigin(const DoubleBox& box) {
  Vec3d origin = Vec3d::Zero();
  const double extent = (box.upper - box.lower).maxCoeff();
  if (!(extent > 0.0) || !std::isfinite(extent)) return origin;
  const double step = std::min(1.0, std::exp2(std::floor(std::log2(extent))));
  for (int axis = 0; axis < 3; ++axis) {
    const double most = std::max(std::abs(box.lower[axis]), std::abs(box.upper[axis]));
    if (most > kFarExtents * extent || (most > kFarMetres && most > kFewExtents * extent)) {
      const double middle = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
      const double steps = middle / step;
      origin[axis] = std::abs(steps) < 0x1p52 ? step * std::round(steps) : middle;
    }
  }
  return origin;
}

void noteFarOrigin(const Vec3d& origin, Diagnosis& diagnosis) {
  if (origin.isZero(0.0)) return;
  diagnosis.add(Severity::Note, "far-origin", 0,
                fmt::format("the scene stands far from the origin, where floats would lose its "
                            "shape: {}, {}, {} was subtracted from all positions and cameras, and "
                            "is kept as its origin",
                            origin.x(), origin.y(), origin.z()));
}

}  // namespace lambent::scene_io
