// This work is based on:
// - sloan2002precomputed: eq. 5, the real basis (here with positive signs throughout).
// - press2007numerical: §6.7, the recurrence over l of normalised Legendre functions at fixed m,
//   which is stable; the constants are in legendre_table.h.
//
// We keep the recurrence in single precision as well, unrolled with constants known at compile
// time. Expanded polynomials in z are no faster, and cancel: at l = 9 they lose two digits near the
// poles.
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
