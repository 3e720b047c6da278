// Products of spherical functions: triple products (Gaunt coefficients), product matrices (Sloan
// 2002 eq. 7), and the product of two vectors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/sh/coefficients.h"

namespace lambent::sh {

/// ∫ y_i y_j y_k ds, exact to double rounding.
double tripleProduct(int i, int j, int k);

/// The non-zero triple products for i < rowBands², j < columnBands², k < functionBands², sorted by
/// (i, j, k). 25×25×81 has 2229 entries. Made once per shape and kept; safe to call from any
/// thread.
struct TripleProductTensor {
  struct Entry {
    std::uint16_t i, j, k;
    double value;
  };
  int rowBands = 0, columnBands = 0, functionBands = 0;
  std::vector<Entry> entries;
};
const TripleProductTensor& tripleProductTensor(int rowBands, int columnBands, int functionBands);

/// â_ij = Σ_k a_k ∫ y_i y_j y_k ds: the matrix that multiplies a function of columnBands by a and
/// projects onto rowBands (eq. 7). Exact when `a` has rowBands+columnBands−1 bands.
/// out: rowBands² × columnBands², row-major.
void productMatrix(std::span<const double> a, int rowBands, int columnBands, std::span<double> out);

/// c = projection of a·b onto as many bands as a and b have (bands 1 … 10, a, b, c of bands²).
void product(int bands, std::span<const float> a, std::span<const float> b, std::span<float> c);

}  // namespace lambent::sh
