#include <algorithm>
#include <vector>

#include "lambent/synthesis/appearance.h"

namespace lambent::synthesis {

double regularityOf(const Appearance& appearance) {
  const int width = appearance.width, height = appearance.height;
  const std::size_t places = std::size_t(width) * height;
  const int dimensions = appearance.dimensions;
  std::vector<double> mean(dimensions);
  for (std::size_t p = 0; p < places; ++p)
    for (int d = 0; d < dimensions; ++d) mean[d] += appearance.values[p * dimensions + d];
  std::vector<float> centred(appearance.values);
  double variance = 0.0;
  for (std::size_t p = 0; p < places; ++p)
    for (int d = 0; d < dimensions; ++d) {
      float& value = centred[p * dimensions + d];
      value -= float(mean[d] / double(places));
      variance += double(value) * value;
    }
  if (!(variance > 0.0)) return 1.0;  // a patch of one colour
  // Every second place along each axis is enough to compare by.
  const int stepX = width >= 32 ? 2 : 1, stepY = height >= 32 ? 2 : 1;
  double best = 0.0;
  for (int dy = 0; dy <= height / 2; ++dy)
    for (int dx = 0; dx < width; ++dx) {
      const int nearX = std::min(dx, width - dx);
      if (4 * nearX < width && 4 * dy < height) continue;
      double sum = 0.0, own = 0.0;
      for (int y = 0; y < height; y += stepY)
        for (int x = 0; x < width; x += stepX) {
          const float* a = centred.data() + (std::size_t(y) * width + x) * dimensions;
          const float* b = centred.data() +
                           (std::size_t((y + dy) % height) * width + (x + dx) % width) * dimensions;
          for (int d = 0; d < dimensions; ++d)
            sum += double(a[d]) * b[d], own += double(a[d]) * a[d];
        }
      if (own > 0.0) best = std::max(best, sum / own);
    }
  return std::clamp(best, 0.0, 1.0);
}

}  // namespace lambent::synthesis
