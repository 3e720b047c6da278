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
// The angles never appear, only their cosines and sines. γ comes from the matrix after Z(−α) is
// taken off it, so that near β = 0 and π, where α alone means nothing, the error in α is made good.
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
};

/// The turns of the rotation q (column-major), off the circle by what q is off a rotation.
inline ZyzTurns zyzTurns(const float* q) {
  const float x = q[6], y = q[7], sine2 = x * x + y * y;
  const bool tilted = sine2 > 1e-20f;
  const float sine = tilted ? __builtin_sqrtf(sine2) : 0, inverse = tilted ? 1 / sine : 0;
  const float cosAlpha = tilted ? x * inverse : 1, sinAlpha = y * inverse;
  return {{cosAlpha * q[4] - sinAlpha * q[3], q[8], cosAlpha},
          {cosAlpha * q[1] - sinAlpha * q[0], -sine, sinAlpha}};
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
  for (int i = 0; i < 3; ++i) ontoCircle(t.cosine[i], t.sine[i]);
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
