// Four-point interpolation on even nodes.
#pragma once

#include <algorithm>
#include <cmath>

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

}  // namespace lambent::sky
