// This work is based on:
// - sloan2002precomputed: Appendix, rotation as z·y·z with the turn about y made of turns about z
//   between fixed changes of axes.
// - ivanic1996rotation: the explicit matrix (rotation_recurrence.h).
//
// One vector is rotated as Z(α) S Z(−β) S Z(γ), where Z(φ) is a turn about z (two by two, cos mφ
// and sin mφ) and S the mirror that swaps y and z. We take the mirror where others take a quarter
// turn about x: S is its own inverse and symmetric, and a turn about y is S Z S with the angle
// negated. A function's parities under x, y and z are kept or swapped by S, so each row of S has an
// entry in every second column of one sign of m only: a quarter of the block.
//
// The angles never appear, only their cosines and sines. γ comes from the matrix after Z(−α) is
// taken off it, so that near β = 0 and π, where α alone means nothing, the error in α is made good.
#include "lambent/sh/rotation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "lambent/sh/rotation_recurrence.h"

namespace lambent::sh {

namespace {

constexpr int kMaxWidth = 2 * kMaxBands - 1;

/// S, band by band: entry (m, n) of band l at [l][(m + l)(2l + 1) + n + l].
struct SwapTable {
  std::array<std::array<float, kMaxWidth * kMaxWidth>, kMaxBands> band{};
};

constexpr SwapTable makeSwapTable() {
  const double band1[9] = {0, 1, 0, 1, 0, 0, 0, 0, 1};  // (y, z, x) → (z, y, x)
  std::array<double, kMaxWidth * kMaxWidth> below{}, block{};
  SwapTable table;
  table.band[0][0] = 1;
  block[0] = 1;
  for (int l = 1; l < kMaxBands; ++l) {
    below = block;
    rotationOfNextBand(l, band1, below.data(), block.data());
    for (int i = 0; i < (2 * l + 1) * (2 * l + 1); ++i) table.band[l][i] = float(block[i]);
  }
  return table;
}

constexpr SwapTable kSwap = makeSwapTable();

/// cos mφ and sin mφ for m = 0 … Bands − 1.
template <int Bands>
struct Turn {
  float cosine[Bands], sine[Bands];

  Turn(float c, float s) {
    cosine[0] = 1;
    sine[0] = 0;
#pragma GCC unroll 16
    for (int m = 1; m < Bands; ++m) {
      cosine[m] = c * cosine[m - 1] - s * sine[m - 1];
      sine[m] = s * cosine[m - 1] + c * sine[m - 1];
    }
  }
};

/// f turned about z.
template <int Bands>
inline void turnAboutZ(const Turn<Bands>& turn, float* f) {
#pragma GCC unroll 16
  for (int l = 1; l < Bands; ++l) {
#pragma GCC unroll 16
    for (int m = 1; m <= l; ++m) {
      const float a = f[index(l, m)], b = f[index(l, -m)];
      f[index(l, m)] = turn.cosine[m] * a - turn.sine[m] * b;
      f[index(l, -m)] = turn.sine[m] * a + turn.cosine[m] * b;
    }
  }
}

/// Row M of S on band L.
template <int L, int M>
inline float swapRow(const float* f) {
  constexpr bool kColumnsEven = (L + M) % 2 == 0;    // even in z becomes even in y: n ≥ 0
  constexpr int kParity = (M >= 0 ? L : L + 1) % 2;  // even in y becomes even in z: l + n even
  float sum = 0;
#pragma GCC unroll 16
  for (int a = kParity; a <= L; a += 2) {
    if (!kColumnsEven && a == 0) continue;
    const int n = kColumnsEven ? a : -a;
    sum += kSwap.band[L][(M + L) * (2 * L + 1) + n + L] * f[n + L];
  }
  return sum;
}

template <int L, int... Row>
inline void swapBand(const float* f, float* out, std::integer_sequence<int, Row...>) {
  ((out[Row] = swapRow<L, Row - L>(f)), ...);
}

template <int... L>
inline void swapAxes(const float* f, float* out, std::integer_sequence<int, L...>) {
  (swapBand<L>(f + L * L, out + L * L, std::make_integer_sequence<int, 2 * L + 1>()), ...);
}

struct ZyzAngles {
  float cosAlpha, sinAlpha, cosBeta, sinBeta, cosGamma, sinGamma;
};

/// (c, s) a hair off the circle, back onto it: one Newton step for 1/√(c² + s²).
inline void ontoCircle(float& c, float& s) {
  const float scale = 1.5f - 0.5f * (c * c + s * s);
  c *= scale;
  s *= scale;
}

inline ZyzAngles zyzAngles(const Mat3& q) {
  ZyzAngles e;
  const float sine2 = q(0, 2) * q(0, 2) + q(1, 2) * q(1, 2);
  const bool turned = sine2 > 1e-20f;
  const float sine = std::sqrt(sine2), inverse = 1 / (turned ? sine : 1.0f);
  e.cosAlpha = turned ? q(0, 2) * inverse : 1.0f;
  e.sinAlpha = turned ? q(1, 2) * inverse : 0.0f;
  e.cosBeta = q(2, 2);
  e.sinBeta = turned ? sine : 0.0f;
  e.sinGamma = e.cosAlpha * q(1, 0) - e.sinAlpha * q(0, 0);
  e.cosGamma = e.cosAlpha * q(1, 1) - e.sinAlpha * q(0, 1);
  ontoCircle(e.cosAlpha, e.sinAlpha);
  ontoCircle(e.cosBeta, e.sinBeta);
  ontoCircle(e.cosGamma, e.sinGamma);
  return e;
}

template <int Bands>
void rotateFixed(const Mat3& q, const float* in, float* out) {
  constexpr auto kBandList = std::make_integer_sequence<int, Bands>();
  const ZyzAngles e = zyzAngles(q);
  float f[Bands * Bands], g[Bands * Bands];
  std::copy_n(in, Bands * Bands, f);
  turnAboutZ(Turn<Bands>(e.cosGamma, e.sinGamma), f);
  swapAxes(f, g, kBandList);
  turnAboutZ(Turn<Bands>(e.cosBeta, -e.sinBeta), g);
  swapAxes(g, f, kBandList);
  turnAboutZ(Turn<Bands>(e.cosAlpha, e.sinAlpha), f);
  std::copy_n(f, Bands * Bands, out);
}

[[maybe_unused]] bool isRotation(const Mat3d& q, double tolerance) {
  const Mat3d excess = q.transpose() * q - Mat3d::Identity();
  return excess.cwiseAbs().maxCoeff() <= tolerance && q.row(0).cross(q.row(1)).dot(q.row(2)) > 0;
}

}  // namespace

void rotate(int bands, const Mat3& q, std::span<const float> in, std::span<float> out) {
  assert(bands >= 1 && bands <= kMaxBands);
  assert(in.size() >= std::size_t(coefficientCount(bands)));
  assert(out.size() >= std::size_t(coefficientCount(bands)));
  assert(isRotation(q.cast<double>(), 1e-4));
  switch (bands) {
    case 1:
      return rotateFixed<1>(q, in.data(), out.data());
    case 2:
      return rotateFixed<2>(q, in.data(), out.data());
    case 3:
      return rotateFixed<3>(q, in.data(), out.data());
    case 4:
      return rotateFixed<4>(q, in.data(), out.data());
    case 5:
      return rotateFixed<5>(q, in.data(), out.data());
    case 6:
      return rotateFixed<6>(q, in.data(), out.data());
    case 7:
      return rotateFixed<7>(q, in.data(), out.data());
    case 8:
      return rotateFixed<8>(q, in.data(), out.data());
    case 9:
      return rotateFixed<9>(q, in.data(), out.data());
    case 10:
      return rotateFixed<10>(q, in.data(), out.data());
    default:
      return;
  }
}

RgbCoefficients rotate(const Mat3& dstFromSrc, const RgbCoefficients& f) {
  RgbCoefficients result(f.bands);
  for (int c = 0; c < 3; ++c) rotate(f.bands, dstFromSrc, f.channel(c), result.channel(c));
  return result;
}

std::vector<double> rotationMatrix(int bands, const Mat3d& q) {
  assert(bands >= 1 && bands <= kTableBands);
  assert(isRotation(q, 1e-4));
  constexpr int kAxis[3] = {1, 2, 0};  // band 1 is over (y, z, x)
  double band1[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) band1[i * 3 + j] = q(kAxis[i], kAxis[j]);
  const int count = coefficientCount(bands);
  std::vector<double> matrix(std::size_t(count) * std::size_t(count), 0.0);
  std::vector<double> below, block{1.0};
  matrix[0] = 1;
  for (int l = 1; l < bands; ++l) {
    const int width = 2 * l + 1, first = l * l;
    below.swap(block);
    block.resize(std::size_t(width * width));
    rotationOfNextBand(l, band1, below.data(), block.data());
    for (int i = 0; i < width; ++i)
      std::copy_n(block.begin() + i * width, width,
                  matrix.begin() + std::ptrdiff_t(first + i) * count + first);
  }
  return matrix;
}

}  // namespace lambent::sh
