// FLIP: how visible a difference is to a person who flips between two pictures.
#pragma once

#include <vector>

#include "lambent/image/image.h"

namespace lambent::image {

/// The LDR-FLIP error of every pixel, 0 (equal) … 1, for two display-referred pictures of one size:
/// linear RGB with Rec. 709 primaries, clamped to [0, 1]. (andersson2020flip)
std::vector<float> flip(const Image& test, const Image& reference, float pixelsPerDegree = 67.0f);

/// The mean of a FLIP map, the figure that pictures are ranked by.
double meanOf(const std::vector<float>& map);

}  // namespace lambent::image
