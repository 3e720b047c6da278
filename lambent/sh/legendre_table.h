// The constants of the normalised Legendre recurrence, made at compile time. Internal to this room.
//
// Y_lm = P_l|m|(z) · {Re, Im} (x + iy)^|m|, where P_lm is a polynomial in z: the associated
// Legendre function without its sinᵐθ (which is in (x + iy)ᵐ) and without the Condon-Shortley sign,
// but with the normalisation and, for m > 0, the √2 of the real basis:
//   P_mm  = kDiagonal[m]
//   P_lm  = kStep[l][m] z P_{l−1,m} − kBack[l][m] P_{l−2,m}
//
// This header includes nothing, since kernels compiled for several instruction sets include it.
#pragma once

namespace lambent::sh {

inline constexpr int kTableBands = 32;

/// Newton's method; for compile time, where std::sqrt is not yet to be had.
constexpr double squareRoot(double x) {
  if (x <= 0) return 0;
  double root = x > 1 ? x : 1;
  for (double last = root + 1; root < last;) {
    last = root;
    root = (last + x / last) / 2;
  }
  return root;
}

struct LegendreTable {
  double diagonal[kTableBands] = {};
  double step[kTableBands][kTableBands] = {}, back[kTableBands][kTableBands] = {};
};

consteval LegendreTable makeLegendreTable() {
  LegendreTable t;
  double square = 1 / (4 * 3.14159265358979323846);  // (2m+1)!! / (4π (2m)!!)
  t.diagonal[0] = squareRoot(square);
  for (int m = 1; m < kTableBands; ++m) {
    square *= (2.0 * m + 1) / (2.0 * m);
    t.diagonal[m] = squareRoot(2 * square);
  }
  for (int l = 1; l < kTableBands; ++l)
    for (int m = 0; m < l; ++m) {
      const double l2 = double(l) * l, m2 = double(m) * m, k2 = double(l - 1) * (l - 1);
      t.step[l][m] = squareRoot((4 * l2 - 1) / (l2 - m2));
      t.back[l][m] = squareRoot((4 * l2 - 1) * (k2 - m2) / ((l2 - m2) * (4 * k2 - 1)));
    }
  return t;
}

inline constexpr LegendreTable kLegendre = makeLegendreTable();

}  // namespace lambent::sh
