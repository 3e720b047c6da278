// Pixels that no light can have.
#pragma once

#include <cstdint>

#include "lambent/image/image.h"

namespace lambent::image {

struct Repairs {
  std::uint64_t notANumber = 0;  ///< channels that were NaN, now 0
  std::uint64_t infinite = 0;    ///< channels that were +∞, now the largest finite value around
  std::uint64_t negative = 0;    ///< channels below 0 (−∞ too), now 0
  std::uint64_t total() const { return notANumber + infinite + negative; }
};

/// Makes every channel finite and not negative, as radiance is. An infinite channel becomes the
/// largest finite value of its channel in the picture (0 if there is none): a half-float overflow
/// of the Sun's disc is as bright as the brightest that was recorded.
Repairs makeRadiance(Image& image);

}  // namespace lambent::image
