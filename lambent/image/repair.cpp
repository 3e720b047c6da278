#include "lambent/image/repair.h"

#include <algorithm>
#include <cmath>

namespace lambent::image {

Repairs makeRadiance(Image& image) {
  Rgb largest = Rgb::Zero();
  for (const Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      if (std::isfinite(pixel[c])) largest[c] = std::max(largest[c], pixel[c]);
    }
  }
  Repairs repairs;
  for (Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      float& value = pixel[c];
      if (std::isnan(value)) {
        ++repairs.notANumber;
        value = 0.0f;
      } else if (value < 0.0f) {
        ++repairs.negative;
        value = 0.0f;
      } else if (std::isinf(value)) {
        ++repairs.infinite;
        value = largest[c];
      }
    }
  }
  return repairs;
}

}  // namespace lambent::image
