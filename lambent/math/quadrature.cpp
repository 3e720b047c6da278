// Newton's method on the Legendre polynomial P_n from Tricomi's estimate of its roots
// (press2007numerical §4.6; abramowitz1964handbook 25.4.29 for the weights,
// w_i = 2 / ((1 − x_i²) P_n'(x_i)²)).
#include "lambent/math/quadrature.h"

#include <cassert>
#include <cmath>
#include <cstddef>

#include "lambent/math/types.h"

namespace lambent::math {

Quadrature gaussLegendre(int n, double low, double high) {
  assert(n >= 1);
  Quadrature rule;
  rule.nodes.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  const double middle = (high + low) / 2, half = (high - low) / 2;
  for (int i = 0; i < (n + 1) / 2; ++i) {
    const double tricomi = 1 - 1.0 / (8.0 * n * n) + 1.0 / (8.0 * n * n * n);
    double x = tricomi * std::cos(kPi * (4.0 * i + 3) / (4.0 * n + 2));
    if (2 * i + 1 == n) x = 0;
    double derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double previous = 1, current = x;
      for (int l = 1; l < n; ++l) {
        const double next = ((2 * l + 1) * x * current - l * previous) / (l + 1);
        previous = current;
        current = next;
      }
      derivative = n * (previous - x * current) / ((1 - x) * (1 + x));
      const double step = current / derivative;
      x -= step;
      if (std::abs(step) <= 1e-16) break;
    }
    const double weight = 2 / ((1 - x) * (1 + x) * derivative * derivative);
    const auto first = static_cast<std::size_t>(i), last = static_cast<std::size_t>(n - 1 - i);
    rule.nodes[first] = middle - half * x;
    rule.nodes[last] = middle + half * x;
    rule.weights[first] = rule.weights[last] = half * weight;
  }
  return rule;
}

}  // namespace lambent::math
