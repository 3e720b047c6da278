#include "lambent/sh/coefficients.h"

#include <algorithm>

namespace lambent::sh {

RgbCoefficients withBands(const RgbCoefficients& f, int bands) {
  RgbCoefficients result(bands);
  const auto shared = std::size_t(coefficientCount(std::min(bands, f.bands)));
  for (int c = 0; c < 3; ++c) {
    const std::span<const float> from = f.channel(c);
    std::copy_n(from.begin(), shared, result.channel(c).begin());
  }
  return result;
}

}  // namespace lambent::sh
