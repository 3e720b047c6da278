// Charts put next to each other on a square of texels, as large as they fit.
#pragma once

#include <vector>

#include "lambent/atlas/flatten.h"
#include "lambent/report/result.h"

namespace lambent::atlas {

/// What packing needs to know of a chart.
struct PackShape {
  std::vector<std::vector<Vec2d>> outlines;  ///< closed, metres; what lies in an odd number is in
  double area = 0.0;                         ///< m²
  Vec2d anchor = Vec2d::Zero();  ///< a place inside that comes to lie on a texel's centre
};

/// texel coordinates = linear · p + offset; `linear` turns and scales.
struct Placement {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2d offset = Vec2d::Zero();
};

struct Packing {
  double scale = 0.0;  ///< texels a metre, the same for all charts but those below a texel
  std::vector<Placement> placements;
};

struct PackOptions {
  int size = 2048;  ///< texels a side
  int gutter = 2;   ///< whole texels that no chart touches, between charts and before the border
};

/// BadUsage if the square is too small for so many charts with their gutters.
Result<Packing> pack(const std::vector<PackShape>& shapes, const PackOptions& options);

}  // namespace lambent::atlas
