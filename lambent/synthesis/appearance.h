// What a patch looks like, place by place, in a few numbers: what synthesis compares instead of
// whole responses (Lefebvre 2006 §3; the textons of Tong 2002 did this at the cost of hours).
#pragma once

#include <vector>

#include "lambent/math/types.h"
#include "lambent/meso/radiance_transfer_texture.h"

namespace lambent::synthesis {

/// A toroidal grid of descriptors.
struct Appearance {
  int width = 0, height = 0, dimensions = 0;
  std::vector<float> values;  ///< [y][x][dimension]
  double keptVariance = 1.0;  ///< share of the variance that the dimensions hold
  const float* at(int x, int y) const {
    return values.data() + (std::size_t(y) * width + x) * dimensions;
  }
};

/// Principal components of the responses B(u, ·) over views, coefficients and channels, scaled so
/// that Euclidean distance between descriptors is the distance between responses, for light of
/// natural falloff over the bands.
Appearance appearanceOf(const meso::RadianceTransferTexture& rtt, int dimensions = 8);

}  // namespace lambent::synthesis
