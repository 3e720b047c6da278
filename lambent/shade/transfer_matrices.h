// M L: stored matrices times a light, for every receiver.
#pragma once

#include <cstddef>
#include <vector>

#include "lambent/encode/encoded_field.h"
#include "lambent/sh/coefficients.h"

namespace lambent::shade {

/// Matrices as they are stored: [receiver][channel][row][column].
struct MatrixShape {
  std::size_t receivers = 0;
  int channels = 1;  ///< 1 (the same for R, G, B) or 3
  int rows = 0, columns = 0;
};

/// [receiver][3][row], all threads. A light of fewer coefficients than there are columns counts as
/// zero beyond; one of more is cut.
std::vector<float> applyMatrices(const encode::Numbers& matrices, const MatrixShape& shape,
                                 const sh::RgbCoefficients& light);

}  // namespace lambent::shade
