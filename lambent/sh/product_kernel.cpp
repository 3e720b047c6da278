// The product of two vectors of n bands, projected to n bands again, through the sphere: both
// functions on the rings of a Gauss-Legendre rule as Fourier series in azimuth, the series
// multiplied and cut to n terms, and the result projected. Exact, as the tensor of triple products
// is, since the rule has the degree 3(n−1).
//
// Why not the tensor: for 5 bands it has 1158 entries, 620 by symmetry, with scattered reads and
// writes; the way through 7 rings takes some 150 operations on vectors of 4. The rings lie
// symmetrically about the equator, and P_lm(−z) = (−1)^(l+m) P_lm(z): the even and the odd
// functions are summed apart on z ≥ 0, and their sum and difference are the northern and southern
// series.
//
// Terms: f.cosine[m] and f.sine[m] are the series Σ cosine[m] cos mφ + sine[m] sin mφ on each ring.
#include "lambent/sh/product_kernel.h"

// How vectors of 8 are passed differs between instruction sets. Here everything is inlined, so
// nothing of the kind is passed.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace lambent::sh::LAMBENT_ISA {
namespace {

using V4 = float __attribute__((vector_size(16)));
using V8 = float __attribute__((vector_size(32)));

template <int Lanes>
struct Register;
template <>
struct Register<4> {
  using Type = V4;
};
template <>
struct Register<8> {
  using Type = V8;
};

template <int Lanes>
inline typename Register<Lanes>::Type load(const float* p) {
  typename Register<Lanes>::Type v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

template <int Bands, int Lanes>
struct Series {
  typename Register<Lanes>::Type cosine[Bands], sine[Bands];
};

template <int Bands, int Lanes>
inline void synthesize(const float* rings, const float* f, Series<Bands, Lanes>& north,
                       Series<Bands, Lanes>& south) {
  using V = typename Register<Lanes>::Type;
#pragma GCC unroll 16
  for (int m = 0; m < Bands; ++m) {
    V cosine[2] = {V{}, V{}}, sine[2] = {V{}, V{}};  // even, odd
#pragma GCC unroll 16
    for (int l = m; l < Bands; ++l) {
      const V p = load<Lanes>(rings + 2 * Lanes * (l * (l + 1) / 2 + m));
      cosine[(l - m) & 1] += p * f[l * (l + 1) + m];
      if (m > 0) sine[(l - m) & 1] += p * f[l * (l + 1) - m];
    }
    north.cosine[m] = cosine[0] + cosine[1];
    south.cosine[m] = cosine[0] - cosine[1];
    if (m > 0) {
      north.sine[m] = sine[0] + sine[1];
      south.sine[m] = sine[0] - sine[1];
    }
  }
}

/// Terms 0 … Bands − 1 of the product of two series, those with m > 0 doubled.
template <int Bands, int Lanes>
inline void multiply(const Series<Bands, Lanes>& a, const Series<Bands, Lanes>& b,
                     Series<Bands, Lanes>& c) {
  using V = typename Register<Lanes>::Type;
  V mean = a.cosine[0] * b.cosine[0] * 2.0f;
#pragma GCC unroll 16
  for (int m = 1; m < Bands; ++m) {
    mean += a.cosine[m] * b.cosine[m] + a.sine[m] * b.sine[m];
    c.cosine[m] = (a.cosine[0] * b.cosine[m] + a.cosine[m] * b.cosine[0]) * 2.0f;
    c.sine[m] = (a.cosine[0] * b.sine[m] + a.sine[m] * b.cosine[0]) * 2.0f;
  }
  c.cosine[0] = mean * 0.5f;
#pragma GCC unroll 16
  for (int p = 1; p < Bands; ++p) {
#pragma GCC unroll 16
    for (int q = 1; q < Bands; ++q) {
      const V cc = a.cosine[p] * b.cosine[q], ss = a.sine[p] * b.sine[q];
      const V cs = a.cosine[p] * b.sine[q], sc = a.sine[p] * b.cosine[q];
      if (p + q < Bands) {
        c.cosine[p + q] += cc - ss;
        c.sine[p + q] += cs + sc;
      }
      if (p > q) {
        c.cosine[p - q] += cc + ss;
        c.sine[p - q] += sc - cs;
      } else if (q > p) {
        c.cosine[q - p] += cc + ss;
        c.sine[q - p] += cs - sc;
      }
    }
  }
}

/// Four partial sums out of four or eight.
inline V4 fold(const V4& v) {
  return v;
}
inline V4 fold(const V8& v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

/// Projects the product's northern and southern series: c_lm = Σ over rings, four at a time.
template <int Bands, int Lanes>
inline void analyze(const float* rings, const Series<Bands, Lanes>& north,
                    const Series<Bands, Lanes>& south, float* c) {
  using V = typename Register<Lanes>::Type;
  constexpr int kCount = Bands * Bands, kPadded = (kCount + 3) / 4 * 4;
  V4 part[kPadded];
#pragma GCC unroll 4
  for (int i = kCount; i < kPadded; ++i) part[i] = V4{};
#pragma GCC unroll 16
  for (int m = 0; m < Bands; ++m) {
    const V cosine[2] = {north.cosine[m] + south.cosine[m], north.cosine[m] - south.cosine[m]};
    V sine[2] = {V{}, V{}};
    if (m > 0) {
      sine[0] = north.sine[m] + south.sine[m];
      sine[1] = north.sine[m] - south.sine[m];
    }
#pragma GCC unroll 16
    for (int l = m; l < Bands; ++l) {
      const V p = load<Lanes>(rings + 2 * Lanes * (l * (l + 1) / 2 + m) + Lanes);
      part[l * (l + 1) + m] = fold(p * cosine[(l - m) & 1]);
      if (m > 0) part[l * (l + 1) - m] = fold(p * sine[(l - m) & 1]);
    }
  }
#pragma GCC unroll 32
  for (int i = 0; i < kPadded; i += 4) {
    const V4 ab = __builtin_shufflevector(part[i], part[i + 1], 0, 4, 1, 5) +
                  __builtin_shufflevector(part[i], part[i + 1], 2, 6, 3, 7);
    const V4 cd = __builtin_shufflevector(part[i + 2], part[i + 3], 0, 4, 1, 5) +
                  __builtin_shufflevector(part[i + 2], part[i + 3], 2, 6, 3, 7);
    const V4 sum =
        __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k)
      if (i + k < kCount) c[i + k] = sum[k];
  }
}

template <int Bands, int Lanes>
void product(const float* rings, const float* a, const float* b, float* c) {
  Series<Bands, Lanes> aNorth, aSouth, bNorth, bSouth, north, south;
  synthesize(rings, a, aNorth, aSouth);
  synthesize(rings, b, bNorth, bSouth);
  multiply(aNorth, bNorth, north);
  multiply(aSouth, bSouth, south);
  analyze(rings, north, south, c);
}

}  // namespace

ProductKernels productKernels() {
  return {{nullptr, product<1, productLanes(1)>, product<2, productLanes(2)>,
           product<3, productLanes(3)>, product<4, productLanes(4)>, product<5, productLanes(5)>,
           product<6, productLanes(6)>, product<7, productLanes(7)>, product<8, productLanes(8)>,
           product<9, productLanes(9)>, product<10, productLanes(10)>}};
}

}  // namespace lambent::sh::LAMBENT_ISA
