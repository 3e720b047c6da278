// Gauss-Legendre quadrature.
#pragma once

#include <vector>

namespace lambent::math {

struct Quadrature {
  std::vector<double> nodes;    ///< rising
  std::vector<double> weights;  ///< sum to the interval's length
};

/// The n-point Gauss-Legendre rule on [low, high]: exact for polynomials of degree 2n − 1. n ≥ 1;
/// nodes and weights are right to a few units in the last place for n up to several thousand.
Quadrature gaussLegendre(int n, double low = -1, double high = 1);

}  // namespace lambent::math
