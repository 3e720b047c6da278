// Four-point interpolation on even nodes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lambent::sky {

/// The first of `taps` nodes around a coordinate, and their weights: Lagrange's cubic through four
/// of the nodes 0 … count − 1, or linear between two.
struct Taps {
  int first = 0;
  int count = 4;
  double weight[4] = {};
};

/// count ≥ 4 for cubic, ≥ 2 for linear. A coordinate outside of the nodes counts as the nearest.
inline Taps cubicTaps(double coordinate, int count) {
  const double x = std::clamp(coordinate, 0.0, double(count - 1));
  const int first = std::clamp(int(std::floor(x)) - 1, 0, count - 4);
  const double t = x - (first + 1);
  Taps taps{first, 4, {}};
  taps.weight[0] = -t * (t - 1) * (t - 2) / 6;
  taps.weight[1] = (t + 1) * (t - 1) * (t - 2) / 2;
  taps.weight[2] = -(t + 1) * t * (t - 2) / 2;
  taps.weight[3] = (t + 1) * t * (t - 1) / 6;
  return taps;
}

inline Taps linearTaps(double coordinate, int count) {
  const double x = std::clamp(coordinate, 0.0, double(count - 1));
  const int first = std::clamp(int(std::floor(x)), 0, count - 2);
  const double t = x - first;
  return {first, 2, {1 - t, t, 0, 0}};
}

/// The cubic B-spline: smooth to its second derivative, through nodes that were made coefficients of
/// (see makeSplines). Straight at both ends. count ≥ 4.
inline Taps splineTaps(double coordinate, int count) {
  const double x = std::clamp(coordinate, 0.0, double(count - 1));
  const int cell = std::clamp(int(std::floor(x)), 0, count - 2);
  const double t = x - cell, s = 1 - t;
  const double weight[4] = {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                            (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  Taps taps{std::clamp(cell - 1, 0, count - 4), 4, {}};
  for (int k = 0; k < 4; ++k) {
    const int node = cell - 1 + k;
    // Nodes beyond the ends go on in a straight line.
    if (node < 0) {
      taps.weight[0] += 2 * weight[k];
      taps.weight[1] -= weight[k];
    } else if (node >= count) {
      taps.weight[3] += 2 * weight[k];
      taps.weight[2] -= weight[k];
    } else {
      taps.weight[node - taps.first] += weight[k];
    }
  }
  return taps;
}

/// Values at `count` nodes, [node][width], become the coefficients of splines through them.
inline void makeSplines(std::vector<float>& values, std::size_t count) {
  if (count < 3) return;
  const std::size_t width = values.size() / count;
  // c₀ and cₙ₋₁ are the values there; (cᵢ₋₁ + 4 cᵢ + cᵢ₊₁)/6 is the value between. Tridiagonal.
  std::vector<double> factor(count);
  const auto at = [&](std::size_t node, std::size_t i) -> float& {
    return values[node * width + i];
  };
  for (std::size_t n = 1; n + 1 < count; ++n) {
    factor[n] = 1 / (4 - (n > 1 ? factor[n - 1] : 0));
    for (std::size_t i = 0; i < width; ++i)
      at(n, i) = float((6 * double(at(n, i)) - double(at(n - 1, i))) * factor[n]);
  }
  for (std::size_t n = count - 2; n >= 1; --n)
    for (std::size_t i = 0; i < width; ++i)
      at(n, i) = float(double(at(n, i)) - factor[n] * double(at(n + 1, i)));
}

}  // namespace lambent::sky
