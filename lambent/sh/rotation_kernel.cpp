// Rotation of one vector, compiled for several instruction sets.
//
// This work is based on:
// - sloan2002precomputed: Appendix, rotation as z·y·z with the turn about y made of turns about z
//   between fixed changes of axes.
//
// The rotation is Z(α) S Z(−β) S Z(γ), where Z(φ) is a turn about z (two by two, cos mφ and sin mφ)
// and S the mirror that swaps y and z. We take the mirror where others take a quarter turn about x:
// S is its own inverse and symmetric, and a turn about y is S Z S with the angle negated. A
// function's parities under x, y and z are kept or swapped by S, so each row of S has an entry in
// every second column of one sign of m only: a quarter of the block.
//
// The angles never appear, only their cosines and sines. γ is that of the matrix's last row; α
// comes from the matrix after Z(γ) is taken off it, so that near β = 0 and π, where γ alone means
// nothing, what is wrong with γ is made good.
#include "lambent/sh/rotation_kernel.h"

#include "lambent/sh/rotation_tables.h"

namespace lambent::sh::LAMBENT_ISA {
namespace {

// std::integer_sequence, without the header.
template <int... I>
struct Integers {};
template <int N, int... I>
struct CountUp {
  using Type = typename CountUp<N - 1, N - 1, I...>::Type;
};
template <int... I>
struct CountUp<0, I...> {
  using Type = Integers<I...>;
};
template <int N>
using UpTo = typename CountUp<N>::Type;

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
      const float a = f[l * (l + 1) + m], b = f[l * (l + 1) - m];
      f[l * (l + 1) + m] = turn.cosine[m] * a - turn.sine[m] * b;
      f[l * (l + 1) - m] = turn.sine[m] * a + turn.cosine[m] * b;
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
inline void swapBand(const float* f, float* out, Integers<Row...>) {
  ((out[Row] = swapRow<L, Row - L>(f)), ...);
}

template <int... L>
inline void swapAxes(const float* f, float* out, Integers<L...>) {
  (swapBand<L>(f + L * L, out + L * L, UpTo<2 * L + 1>()), ...);
}

/// Cosines and sines of the three turns about z: γ, −β and α.
struct ZyzTurns {
  float cosine[3], sine[3];
  float cosine2Gamma, sine2Gamma;  ///< of 2γ
};

/// The turns of the rotation q (column-major). γ is on the circle, the others off it by what q is
/// off a rotation. Everything waits for γ, so γ and 2γ wait for no more than a root or a division.
inline ZyzTurns zyzTurns(const float* q) {
  const float x = -q[2], y = q[5], sine2 = x * x + y * y;  // (cos γ, sin γ) · sin β
  const bool tilted = sine2 > 1e-20f;
  const float sine = tilted ? __builtin_sqrtf(sine2) : 0, inverse2 = tilted ? 1 / sine2 : 0;
  const float cosGamma = tilted ? x * (sine * inverse2) : 1, sinGamma = y * (sine * inverse2);
  return {{cosGamma, q[8], q[1] * sinGamma + q[4] * cosGamma},
          {sinGamma, -sine, -(q[0] * sinGamma + q[3] * cosGamma)},
          tilted ? (x * x - y * y) * inverse2 : 1,
          2 * (x * y) * inverse2};
}

/// (c, s) a hair off the circle, back onto it: one Newton step for 1/√(c² + s²).
inline void ontoCircle(float& c, float& s) {
  const float scale = 1.5f - 0.5f * (c * c + s * s);
  c *= scale;
  s *= scale;
}

template <int Bands>
void rotateFixed(const float* q, const float* in, float* out) {
  ZyzTurns t = zyzTurns(q);
  ontoCircle(t.cosine[1], t.sine[1]);
  ontoCircle(t.cosine[2], t.sine[2]);
  float f[Bands * Bands], g[Bands * Bands];
  for (int i = 0; i < Bands * Bands; ++i) f[i] = in[i];
  turnAboutZ(Turn<Bands>(t.cosine[0], t.sine[0]), f);
  swapAxes(f, g, UpTo<Bands>());
  turnAboutZ(Turn<Bands>(t.cosine[1], t.sine[1]), g);
  swapAxes(g, f, UpTo<Bands>());
  turnAboutZ(Turn<Bands>(t.cosine[2], t.sine[2]), f);
  for (int i = 0; i < Bands * Bands; ++i) out[i] = f[i];
}

#include "lambent/sh/rotation_five_bands.h"

}  // namespace

RotationKernels rotationKernels() {
  return {{nullptr, rotateFixed<1>, rotateFixed<2>, rotateFixed<3>, rotateFixed<4>, rotateFixed<5>,
           rotateFixed<6>, rotateFixed<7>, rotateFixed<8>, rotateFixed<9>, rotateFixed<10>}};
}

}  // namespace lambent::sh::LAMBENT_ISA
