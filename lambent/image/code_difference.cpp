#include "lambent/image/code_difference.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "lambent/radiometry/srgb.h"

namespace lambent::image {

namespace {

std::array<int, 3> codesOf(const Rgb& linear) {
  std::array<int, 3> codes;
  for (int c = 0; c < 3; ++c) {
    const float light = linear[c] > 0.0f ? std::min(linear[c], 1.0f) : 0.0f;  // NaN: 0
    codes[std::size_t(c)] = int(std::lround(255.0f * radiometry::srgbEncode(light)));
  }
  return codes;
}

}  // namespace

double psnrOf(const CodeDifference& difference) {
  if (difference.rms == 0.0) return std::numeric_limits<double>::infinity();
  return 20.0 * std::log10(255.0 / difference.rms);
}

CodeDifference codeDifference(const Image& a, const Image& b) {
  assert(a.width == b.width && a.height == b.height);
  CodeDifference result;
  std::uint64_t sum = 0, squares = 0;  // black pixels add nothing to them
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const std::array<int, 3> x = codesOf(a.pixels[i]), y = codesOf(b.pixels[i]);
    bool lit = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const int apart = std::abs(x[c] - y[c]);
      sum += std::uint64_t(apart);
      squares += std::uint64_t(apart) * std::uint64_t(apart);
      result.largest = std::max(result.largest, apart);
      lit = lit || x[c] > 0 || y[c] > 0;
    }
    result.litPixels += lit;
  }
  if (!a.pixels.empty()) {
    result.mean = double(sum) / (3.0 * double(a.pixels.size()));
    result.rms = std::sqrt(double(squares) / (3.0 * double(a.pixels.size())));
  }
  if (result.litPixels > 0) result.meanLit = double(sum) / (3.0 * double(result.litPixels));
  return result;
}

}  // namespace lambent::image
