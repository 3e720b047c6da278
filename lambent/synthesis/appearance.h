// What a patch looks like, place by place, in a few numbers: what synthesis compares instead of
// whole responses (lefebvre2006appearance §3; the textons of tong2002synthesis did this at the cost
// of hours).
#pragma once

#include <vector>

#include "lambent/math/types.h"
#include "lambent/transfer/field.h"

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

/// Principal components of the responses B(u, ·) over views, coefficients and channels. Euclidean
/// distance between two places' descriptors is, up to what the components left out keep, the root
/// mean square difference of their exit radiance under light whose every coefficient of band l has
/// unit variance over max(l, 1)²; views weigh by their cosine, channels alike. `dimensions` ≥ 1;
/// those beyond the responses' rank are 0.
Appearance appearanceOf(const transfer::SimulatedRtt& rtt, int dimensions = 8);

/// How far the patch repeats itself within its own period, 0 … 1: the largest autocorrelation of
/// the descriptors at a shift of a quarter of the period or more. A plain weave or a grid of holes
/// has 1; a random relief has little.
double regularityOf(const Appearance& appearance);

}  // namespace lambent::synthesis
