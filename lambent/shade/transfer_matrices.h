// M L: stored matrices times a light, for every receiver.
#pragma once

#include <vector>

#include "lambent/sh/coefficients.h"
#include "lambent/transfer/numbers.h"
#include "lambent/transfer/surface.h"

namespace lambent::shade {

/// [receiver][3][row], all threads. A light of fewer coefficients than there are columns counts as
/// zero beyond; one of more is cut.
std::vector<float> applyMatrices(const transfer::Matrices<transfer::Numbers>& matrices,
                                 const sh::RgbCoefficients& light);

}  // namespace lambent::shade
