// How far two pictures are apart on a screen: in steps of their 8-bit sRGB codes.
#pragma once

#include <cstdint>

#include "lambent/image/image.h"

namespace lambent::image {

/// In units of 1/255, of codes as a PNG holds them; absolute, over the three channels.
struct CodeDifference {
  double mean = 0.0;            ///< over all pixels
  double rms = 0.0;             ///< root of the mean square, over all pixels
  double meanLit = 0.0;         ///< over those that are not black in both pictures; 0 if all are
  int largest = 0;              ///< of one channel of one pixel
  std::uint64_t litPixels = 0;  ///< how many are not black in both
};

/// 20 log₁₀ (255 / rms), dB: the peak signal-to-noise ratio of 8-bit pictures; infinite if equal.
double psnrOf(const CodeDifference& difference);

/// Both display-referred: linear light in [0, 1], as read from PNG or out of a tone curve; what is
/// beyond is clamped, NaN is black. Alpha is not looked at. Asserts on equal sizes.
CodeDifference codeDifference(const Image& a, const Image& b);

}  // namespace lambent::image
