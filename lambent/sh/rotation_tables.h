// The matrix of one band of a rotation from the band below it, and the mirror that swaps the axes y
// and z as a table. Internal to this room.
//
// This work is based on:
// - ivanic1996rotation: eq. 8.1 and Tables 1-2, with the correction of 1998 (Table 2, V for m < 0).
//   R^l_mm' = u U + v V + w W; r is the 3×3 matrix over (y, z, x), which is band 1.
#pragma once

#include "lambent/sh/legendre_table.h"

namespace lambent::sh {

/// below: the (2l−1)² matrix of band l − 1, row-major; out: the (2l+1)² matrix of band l, l ≥ 1.
/// band1: the 3×3 matrix over (y, z, x), row-major. Any orthogonal matrix will do, mirrors
/// included.
constexpr void rotationOfNextBand(int l, const double* band1, const double* below, double* out) {
  const auto root = [](double x) {
    return __builtin_is_constant_evaluated() ? squareRoot(x) : __builtin_sqrt(x);
  };
  const auto r = [&](int i, int j) { return band1[(i + 1) * 3 + (j + 1)]; };
  const auto b = [&](int m, int n) { return below[(m + l - 1) * (2 * l - 1) + (n + l - 1)]; };
  const auto p = [&](int i, int m, int n) {
    if (n == l) return r(i, 1) * b(m, l - 1) - r(i, -1) * b(m, -l + 1);
    if (n == -l) return r(i, 1) * b(m, -l + 1) + r(i, -1) * b(m, l - 1);
    return r(i, 0) * b(m, n);
  };
  if (l == 1) {  // p() counts on l − 1 and −l + 1 being two
    for (int i = 0; i < 9; ++i) out[i] = band1[i];
    return;
  }
  const double root2 = root(2);
  for (int m = -l; m <= l; ++m) {
    const int a = m < 0 ? -m : m;
    const double un = root(double(l + m) * (l - m));
    const double vn = (m == 0 ? -root2 : 1) * root(double(l + a - 1) * (l + a)) / 2;
    const double wn = m == 0 ? 0 : -root(double(l - a - 1) * (l - a)) / 2;
    for (int n = -l; n <= l; ++n) {
      const bool edge = n == l || n == -l;
      double sum = 0;
      if (un != 0) sum += un * p(0, m, n);
      if (m == 0)
        sum += vn * (p(1, 1, n) + p(-1, -1, n));
      else if (m == 1)
        sum += vn * root2 * p(1, 0, n);
      else if (m == -1)
        sum += vn * root2 * p(-1, 0, n);
      else if (m > 0)
        sum += vn * (p(1, m - 1, n) - p(-1, -m + 1, n));
      else
        sum += vn * (p(1, m + 1, n) + p(-1, -m - 1, n));
      if (wn != 0)
        sum += wn * (m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, -m + 1, n));
      out[(m + l) * (2 * l + 1) + (n + l)] =
          sum / root(edge ? 2.0 * l * (2.0 * l - 1) : double(l + n) * (l - n));
    }
  }
}

/// The mirror that swaps y and z, band by band: entry (m, n) of band l at
/// band[l][(m + l)(2l + 1) + n + l]. It is symmetric, and its own inverse.
struct SwapTable {
  float band[10][19 * 19] = {};
};

consteval SwapTable makeSwapTable() {
  const double band1[9] = {0, 1, 0, 1, 0, 0, 0, 0, 1};  // (y, z, x) → (z, y, x)
  double below[19 * 19] = {}, block[19 * 19] = {1};
  SwapTable table;
  table.band[0][0] = 1;
  for (int l = 1; l < 10; ++l) {
    for (int i = 0; i < (2 * l - 1) * (2 * l - 1); ++i) below[i] = block[i];
    rotationOfNextBand(l, band1, below, block);
    for (int i = 0; i < (2 * l + 1) * (2 * l + 1); ++i) table.band[l][i] = float(block[i]);
  }
  return table;
}

inline constexpr SwapTable kSwap = makeSwapTable();

}  // namespace lambent::sh
