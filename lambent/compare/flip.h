// FLIP: the difference between two pictures as a person who flips between them would see it.
#pragma once

#include <vector>

#include "lambent/image/image.h"

namespace lambent::compare {

struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> error;  ///< per pixel in [0, 1], row after row from the top
  double mean = 0.0;         ///< what is quoted as "FLIP"
};

/// Pixels per degree of a 0.7 m wide screen with 3840 pixels seen from 0.7 m (the paper's default).
inline constexpr float kFlipPixelsPerDegree = 67.0206f;

/// LDR-FLIP of two developed pictures of the same size, linear RGB in [0, 1].
FlipMap flip(const image::Image& reference, const image::Image& test,
             float pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace lambent::compare
