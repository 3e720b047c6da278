// This work is based on:
// - ramamoorthi2001efficient: eq. 8-9, the clamped cosine in closed form.
// - sloan2002precomputed: eq. 6 and Appendix: convolution and turning of circularly symmetric
//   functions.
// - henyey1941diffuse: the phase function whose l-th moment is gˡ.
//
// Caps: ∫_c¹ P_l dt = (P_{l−1}(c) − P_{l+1}(c))/(2l+1) = (1 − c²) P_l'(c) / (l(l+1)); the last form
// does not cancel for narrow caps (the sun's disc).
// Phong lobes: I_l = ∫₀¹ tʳ P_l dt obeys I_l = I_{l−2} (r−l+2)/(r+l+1), I_0 = 1/(r+1), I_1 =
// 1/(r+2).
#include "lambent/sh/zonal.h"

#include <cassert>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/sh/basis.h"

namespace lambent::sh {

ZonalMoments clampedCosine(int bands) {
  ZonalMoments moments(std::size_t(bands), 0.0);
  double central = 1;  // l! / (2^l (l/2)!²)
  for (int l = 0; l < bands; l += 2) {
    if (l > 0) central *= (l - 1.0) / l;
    const double sign = (l / 2) % 2 ? 1 : -1;
    moments[l] = 2 * kPi * sign * central / ((l + 2.0) * (l - 1.0));
  }
  if (bands > 1) moments[1] = 2 * kPi / 3;
  return moments;
}

/// Moments of the indicator of cos θ > c, with sine2 = 1 − c² and versine = 1 − c given apart.
static ZonalMoments capMoments(int bands, double c, double sine2, double versine) {
  ZonalMoments moments(std::size_t(bands), 0.0);
  if (bands > 0) moments[0] = 2 * kPi * versine;
  double previous = 1, p = c;           // P_{l−1}, P_l
  double slopePrevious = 0, slope = 1;  // their derivatives
  for (int l = 1; l < bands; ++l) {
    moments[l] = 2 * kPi * sine2 * slope / (l * (l + 1.0));
    const double next = ((2 * l + 1) * c * p - l * previous) / (l + 1);
    const double slopeNext = slopePrevious + (2 * l + 1) * p;
    previous = p;
    p = next;
    slopePrevious = slope;
    slope = slopeNext;
  }
  return moments;
}

ZonalMoments hemisphere(int bands) {
  return capMoments(bands, 0, 1, 1);
}

ZonalMoments cap(int bands, double halfAngle) {
  assert(halfAngle >= 0 && halfAngle <= kPi);
  const double half = std::sin(halfAngle / 2), sine = std::sin(halfAngle);
  return capMoments(bands, std::cos(halfAngle), sine * sine, 2 * half * half);
}

ZonalMoments phongLobe(int bands, double exponent) {
  assert(exponent > -1);
  ZonalMoments moments(std::size_t(bands), 0.0);
  for (int l = 0; l < bands; ++l) {
    if (l == 0)
      moments[l] = 1;
    else if (l == 1)
      moments[l] = (exponent + 1) / (exponent + 2);
    else
      moments[l] = moments[l - 2] * (exponent - l + 2) / (exponent + l + 1);
  }
  return moments;
}

ZonalMoments henyeyGreenstein(int bands, double g) {
  ZonalMoments moments(std::size_t(bands), 1.0);
  for (int l = 1; l < bands; ++l) moments[l] = moments[l - 1] * g;
  return moments;
}

// A quadrature with weights w_i > 0 and nodes t_i that is exact for t h(t) gives
//   ĥ_1 = 2π Σ w_i t_i h(t_i) ≤ max t_i · ĥ_0 for h ≥ 0,
// with equality where h vanishes at all nodes but the largest. For n = 2m + 1 bands that is Gauss's
// rule, whose nodes are the roots of q = P_{m+1}, and h = (q/(t − x))² with x the largest of them; for
// n = 2m + 2 Radau's, of q = (P_{m+1} + P_{m+2})/(1 + t) and −1, and h = (1 + t) (q/(t − x))².
ZonalMoments sharpestNonNegative(int bands) {
  assert(bands >= 1);
  const unsigned m = unsigned(bands - 1) / 2;
  const bool even = bands % 2 == 0;
  const auto nodal = [&](double t) {
    return even ? (std::legendre(m + 1, t) + std::legendre(m + 2, t)) / (1 + t)
                : std::legendre(m + 1, t);
  };
  // It is positive right of its largest root, from which the next one is farther than a step.
  double low = 1, high = 1;
  while (nodal(low) > 0 && low > -0.9) low -= 0.25 / (bands * bands);
  for (int i = 0; i < 200 && high > low; ++i) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (nodal(middle) > 0 ? high : low) = middle;
  }
  const double x = (low + high) / 2;
  ZonalMoments moments = zonal(bands, [&](double t) {
    const double root = nodal(t) / (t - x);
    return (even ? 1 + t : 1) * root * root;
  });
  const double whole = moments[0];
  for (double& moment : moments) moment /= whole;
  return moments;
}

ZonalMoments delta(int bands) {
  return ZonalMoments(std::size_t(bands), 1.0);
}

ZonalMoments zonal(int bands, const std::function<double(double)>& h) {
  ZonalMoments moments(std::size_t(bands), 0.0);
  // Lobes are often clamped at the horizon: a rule on each side of it sees no kink.
  for (const double low : {-1.0, 0.0}) {
    const math::Quadrature rule = math::gaussLegendre(128, low, low + 1);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double t = rule.nodes[i], value = 2 * kPi * rule.weights[i] * h(t);
      double previous = 0, p = 1;
      for (int l = 0; l < bands; ++l) {
        moments[l] += value * p;
        const double next = ((2 * l + 1) * t * p - l * previous) / (l + 1);
        previous = p;
        p = next;
      }
    }
  }
  return moments;
}

template <class Real, class Direction>
static void turnToAs(const ZonalMoments& moments, const Direction& axis, std::span<Real> out) {
  const int bands = int(moments.size());
  evaluate(bands, axis, out);
  for (int l = 0; l < bands; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[i] *= Real(moments[l]);
}

void turnTo(const ZonalMoments& moments, const Vec3d& axis, std::span<double> out) {
  turnToAs<double>(moments, axis, out);
}

void turnTo(const ZonalMoments& moments, const Vec3& axis, std::span<float> out) {
  turnToAs<float>(moments, axis, out);
}

void convolve(const ZonalMoments& moments, std::span<float> f) {
  const int bands = bandsOf(f.size());
  assert(bands <= int(moments.size()));
  for (int l = 0; l < bands; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] *= float(moments[l]);
}

}  // namespace lambent::sh
