// This work is based on:
// - sloan2002precomputed: eq. 5, the real basis (here with positive signs throughout).
// - press2007numerical: §6.7, the recurrence over l of normalised Legendre functions at fixed m,
//   which is stable; the constants are in legendre_table.h.
//
// In single precision the recurrence is unrolled, its constants known at compile time. Up to 5
// bands polynomials in z are as accurate, and are evaluated four at a time; further up they cancel
// (at l = 9 two digits are lost near the poles), and the recurrence does not.
#include "lambent/sh/basis.h"

#include <cassert>
#include <utility>

#include "lambent/sh/legendre_table.h"

namespace lambent::sh {

void evaluate(int bands, const Vec3d& direction, std::span<double> out) {
  assert(bands >= 1 && bands <= kTableBands);
  assert(out.size() >= std::size_t(coefficientCount(bands)));
  const double x = direction.x(), y = direction.y(), z = direction.z();
  double cosine = 1, sine = 0;  // of mφ, times sinᵐθ
  for (int m = 0; m < bands; ++m) {
    double previous = 0, p = kLegendre.diagonal[m];
    for (int l = m; l < bands; ++l) {
      if (l > m) {
        const double next = kLegendre.step[l][m] * z * p - kLegendre.back[l][m] * previous;
        previous = p;
        p = next;
      }
      if (m > 0) out[index(l, -m)] = p * sine;
      out[index(l, m)] = p * cosine;
    }
    const double nextCosine = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = nextCosine;
  }
}

namespace {

/// Column m of the triangle of functions, from l = m + Steps on.
template <int Bands, int M, int L>
inline void column(float z, float cosine, float sine, float previous, float p, float* out) {
  if constexpr (L < Bands) {
    if constexpr (M > 0) out[index(L, -M)] = p * sine;
    out[index(L, M)] = p * cosine;
    if constexpr (L + 1 < Bands) {
      constexpr float kStep = float(kLegendre.step[L + 1][M]);
      constexpr float kBack = float(kLegendre.back[L + 1][M]);
      float next = (kStep * z) * p;
      if constexpr (L > M) next -= kBack * previous;
      column<Bands, M, L + 1>(z, cosine, sine, p, next, out);
    }
  }
}

template <int Bands, int M>
inline void columnsFrom(float x, float y, float z, float cosine, float sine, float* out) {
  column<Bands, M, M>(z, cosine, sine, 0.0f, float(kLegendre.diagonal[M]), out);
  if constexpr (M + 1 < Bands) {
    if constexpr (M == 0)
      columnsFrom<Bands, 1>(x, y, z, x, y, out);
    else
      columnsFrom<Bands, M + 1>(x, y, z, x * cosine - y * sine, x * sine + y * cosine, out);
  }
}

template <int Bands>
void evaluateFixed(float x, float y, float z, float* out) {
  columnsFrom<Bands, 0>(x, y, z, 1.0f, 0.0f, out);
}

// Five bands, the usual number, four functions at a time: stores of single floats alone would take
// longer than all of this.
using V4 = float __attribute__((vector_size(16)));

/// The coefficient of zᵏ in P_lm.
constexpr double power(int l, int m, int k) {
  if (k < 0 || k > l - m) return 0;
  if (l == m) return kLegendre.diagonal[m];
  return kLegendre.step[l][m] * power(l - 1, m, k - 1) -
         (l - 2 >= m ? kLegendre.back[l][m] * power(l - 2, m, k) : 0);
}

/// The coefficients of zᵏ in P_lm for four m of one band.
template <int L, int K, int M0, int M1, int M2, int M3>
inline V4 powers() {
  constexpr float k0 = float(power(L, M0, K)), k1 = float(power(L, M1, K));
  constexpr float k2 = float(power(L, M2, K)), k3 = float(power(L, M3, K));
  return V4{k0, k1, k2, k3};
}

inline void store(float* out, const V4& v) {
  __builtin_memcpy(out, &v, sizeof v);
}

template <>
void evaluateFixed<5>(float x, float y, float z, float* out) {
  const float z2 = z * z, cosine2 = x * x - y * y, sine2 = 2 * (x * y);
  // (x + iy)ᵐ for m = 1, 2 and, multiplied by the second, for m = 3, 4.
  const V4 low = {x, y, cosine2, sine2};
  const V4 high = low * cosine2 +
                  __builtin_shufflevector(low, low, 1, 0, 3, 2) * V4{-sine2, sine2, -sine2, sine2};
  const V4 cosine = __builtin_shufflevector(low, high, 0, 2, 4, 6);              // m = 1, 2, 3, 4
  const V4 sine = __builtin_shufflevector(high, low, 3, 1, 7, 5);                // m = 4, 3, 2, 1
  const V4 sineOne = __builtin_shufflevector(sine, V4{1, 1, 1, 1}, 1, 2, 3, 4);  // m = 3, 2, 1; 1

  constexpr float k0 = float(kLegendre.diagonal[0]), k1 = float(kLegendre.diagonal[1]);
  constexpr float k2 = float(kLegendre.diagonal[2]), k21 = float(power(2, 1, 1));
  constexpr float k202 = float(power(2, 0, 2)), k200 = float(power(2, 0, 0));
  store(out, V4{1, y, z, x} * V4{k0, k1, k1, k1});
  store(out + 4, V4{sine2, y * z, z2, x * z} * V4{k2, k21, k202, k21} + V4{0, 0, k200, 0});
  out[8] = k2 * cosine2;
  // In these, what a store puts past its band is overwritten by the next.
  const V4 low3 = (powers<3, 3, 3, 2, 1, 0>() * z2 + powers<3, 1, 3, 2, 1, 0>()) * z +
                  (powers<3, 2, 3, 2, 1, 0>() * z2 + powers<3, 0, 3, 2, 1, 0>());
  store(out + 9, low3 * sineOne);
  store(out + 13, __builtin_shufflevector(low3, low3, 2, 1, 0, 0) * cosine);
  const V4 high4 = (powers<4, 3, 1, 2, 3, 4>() * z2 + powers<4, 1, 1, 2, 3, 4>()) * z +
                   (powers<4, 2, 1, 2, 3, 4>() * z2 + powers<4, 0, 1, 2, 3, 4>());
  store(out + 16, __builtin_shufflevector(high4, high4, 3, 2, 1, 0) * sine);
  constexpr float k404 = float(power(4, 0, 4)), k402 = float(power(4, 0, 2));
  constexpr float k400 = float(power(4, 0, 0));
  out[20] = (k404 * z2 + k402) * z2 + k400;
  store(out + 21, high4 * cosine);
}

}  // namespace

void evaluate(int bands, const Vec3& direction, std::span<float> out) {
  assert(bands >= 1 && bands <= kMaxBands);
  assert(out.size() >= std::size_t(coefficientCount(bands)));
  const float x = direction.x(), y = direction.y(), z = direction.z();
  float* o = out.data();
  switch (bands) {
    case 1:
      return evaluateFixed<1>(x, y, z, o);
    case 2:
      return evaluateFixed<2>(x, y, z, o);
    case 3:
      return evaluateFixed<3>(x, y, z, o);
    case 4:
      return evaluateFixed<4>(x, y, z, o);
    case 5:
      return evaluateFixed<5>(x, y, z, o);
    case 6:
      return evaluateFixed<6>(x, y, z, o);
    case 7:
      return evaluateFixed<7>(x, y, z, o);
    case 8:
      return evaluateFixed<8>(x, y, z, o);
    case 9:
      return evaluateFixed<9>(x, y, z, o);
    case 10:
      return evaluateFixed<10>(x, y, z, o);
    default:
      return;
  }
}

double reconstruct(std::span<const float> coefficients, const Vec3& direction) {
  const int bands = bandsOf(coefficients.size());
  float y[kMaxBands * kMaxBands];
  evaluate(bands, direction, y);
  double sum = 0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) sum += double(coefficients[i]) * y[i];
  return sum;
}

Rgb reconstruct(const RgbCoefficients& f, const Vec3& direction) {
  assert(f.bands >= 1 && f.bands <= kMaxBands);
  float y[kMaxBands * kMaxBands];
  evaluate(f.bands, direction, y);
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const std::span<const float> channel = f.channel(c);
    double sum = 0;
    for (std::size_t i = 0; i < channel.size(); ++i) sum += double(channel[i]) * y[i];
    result[c] = float(sum);
  }
  return result;
}

}  // namespace lambent::sh
