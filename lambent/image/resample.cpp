
#include <algorithm>
#include <cmath>

#include "lambent/image/maps.h"
#include "lambent/work/parallel_for.h"

namespace lambent::image {

Image resample(const Image& source, MapKind sourceKind, const MapShape& target) {
  assert(checkShape({sourceKind, source.width, source.height}) && checkShape(target));
  // Samples per axis and pixel so that no source pixel is stepped over; at least 2, at most 16.
  const double ratio = std::sqrt(static_cast<double>(source.width) * source.height /
                                 (static_cast<double>(target.width) * target.height));
  const int grid = std::clamp(static_cast<int>(std::ceil(ratio)), 2, 16);
  Image out(target.width, target.height);
  work::parallelFor(target.height, [&](int y) {
    for (int x = 0; x < target.width; ++x) {
      Rgb sum = Rgb::Zero();
      int count = 0;
      for (int k = 0; k < grid * grid; ++k) {
        const Vec2d at(x + (k % grid + 0.5) / grid, y + (k / grid + 0.5) / grid);
        if (const std::optional<Vec3d> direction = directionOf(target, at)) {
          sum += sample(source, sourceKind, *direction);
          ++count;
        }
      }
      if (count > 0) out.at(x, y) = sum / static_cast<float>(count);
    }
  });
  return out;
}

}  // namespace lambent::image
