// Sixteen floats side by side, in as many registers as the machine needs for them. Part of
// kernels.cpp, compiled once for each instruction set: everything is internal to it.
//
// GCC's generic vectors are used at the machine's own width. (At 16 floats whatever the machine,
// the compiler splits them through memory: shading was 10 to 25 times slower for AVX2.)
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "lambent/shade/kernels.h"

#define LAMBENT_INLINE inline __attribute__((always_inline))

namespace lambent::shade {
namespace LAMBENT_ISA {
namespace {

#if defined(__AVX512F__)
constexpr int kNative = 16;
#elif defined(__AVX2__)
constexpr int kNative = 8;
#else
constexpr int kNative = 4;
#endif
constexpr int kParts = kBlock / kNative;

typedef float Native __attribute__((vector_size(4 * kNative)));
typedef float NativeUnaligned __attribute__((vector_size(4 * kNative), aligned(4)));
typedef float V8 __attribute__((vector_size(32)));
typedef float V4 __attribute__((vector_size(16)));

LAMBENT_INLINE void storeNative(float* p, Native v) {
  *reinterpret_cast<NativeUnaligned*>(p) = v;
}

LAMBENT_INLINE Native loadNative(const float* p) {
  return *reinterpret_cast<const NativeUnaligned*>(p);
}

#if defined(__AVX512F__)

LAMBENT_INLINE Native loadNative(const std::uint16_t* p) {
  return (Native)_mm512_maskz_cvtph_ps(__mmask16(-1),
                                       _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}

LAMBENT_INLINE Native loadNative(const std::int8_t* p) {
  return (Native)_mm512_maskz_cvtepi32_ps(
      __mmask16(-1), _mm512_maskz_cvtepi8_epi32(
                         __mmask16(-1), _mm_loadu_si128(reinterpret_cast<const __m128i*>(p))));
}

#elif defined(__F16C__)

LAMBENT_INLINE Native loadNative(const std::uint16_t* p) {
  return (Native)_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}

LAMBENT_INLINE Native loadNative(const std::int8_t* p) {
  return (Native)_mm256_cvtepi32_ps(
      _mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
}

#else

// By integers, so that a machine set to flush denormals still reads small halves.
LAMBENT_INLINE Native loadNative(const std::uint16_t* p) {
  typedef std::uint16_t Halves __attribute__((vector_size(8)));
  typedef std::uint16_t HalvesUnaligned __attribute__((vector_size(8), aligned(2)));
  typedef std::int32_t I __attribute__((vector_size(16)));
  const Halves halves = *reinterpret_cast<const HalvesUnaligned*>(p);
  const I h = __builtin_convertvector(halves, I);
  const I sign = (h & 0x8000) << 16, exponent = h & 0x7c00, mantissa = h & 0x03ff;
  const I normal = ((h & 0x7fff) << 13) + (112 << 23);
  const I special = ((h & 0x7fff) << 13) | 0x7f800000;
  const I small = (I)(__builtin_convertvector(mantissa, Native) * 0x1p-24f);
  const I isSmall = exponent == 0, isSpecial = exponent == 0x7c00;
  return (Native)(sign | (isSmall & small) | (isSpecial & special) |
                  (~(isSmall | isSpecial) & normal));
}

LAMBENT_INLINE Native loadNative(const std::int8_t* p) {
  typedef std::int8_t Bytes __attribute__((vector_size(4)));
  typedef std::int8_t BytesUnaligned __attribute__((vector_size(4), aligned(1)));
  return __builtin_convertvector((Bytes) * reinterpret_cast<const BytesUnaligned*>(p), Native);
}

#endif

struct V {
  Native part[kParts] = {};
};

template <class Number>
LAMBENT_INLINE V load(const Number* p) {
  V v;
  for (int i = 0; i < kParts; ++i) v.part[i] = loadNative(p + i * kNative);
  return v;
}

LAMBENT_INLINE void store(float* p, const V& v) {
  for (int i = 0; i < kParts; ++i) storeNative(p + i * kNative, v.part[i]);
}

LAMBENT_INLINE void addProduct(V& sum, const V& a, float b) {
  for (int i = 0; i < kParts; ++i) sum.part[i] += a.part[i] * b;
}

LAMBENT_INLINE void addProduct(V& sum, const V& a, const V& b) {
  for (int i = 0; i < kParts; ++i) sum.part[i] += a.part[i] * b.part[i];
}

LAMBENT_INLINE V4 fold(V4 v) {
  return v;
}
LAMBENT_INLINE V4 fold(V8 v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

LAMBENT_INLINE float sumOfLanes(const V& v) {
#if defined(__AVX512F__)
  const Native whole = v.part[0];
  const V8 sum = __builtin_shufflevector(whole, whole, 0, 1, 2, 3, 4, 5, 6, 7) +
                 __builtin_shufflevector(whole, whole, 8, 9, 10, 11, 12, 13, 14, 15);
#elif defined(__AVX2__)
  const V8 sum = v.part[0] + v.part[1];
#else
  const V4 sum = (v.part[0] + v.part[2]) + (v.part[1] + v.part[3]);
#endif
  const V4 four = fold(sum);
  return (four[0] + four[2]) + (four[1] + four[3]);
}

// r0 … r15, g0 … g15, b0 … b15 → r0 g0 b0 r1 g1 b1 …
#if defined(__AVX512F__)

LAMBENT_INLINE void storeInterleaved(float* out, const V& red, const V& green, const V& blue) {
  const Native r = red.part[0], g = green.part[0], b = blue.part[0];
  // First red and green into their places, then blue: index 16 + i takes the second operand's i.
  const Native t0 =
      __builtin_shufflevector(r, g, 0, 16, 0, 1, 17, 1, 2, 18, 2, 3, 19, 3, 4, 20, 4, 5);
  const Native t1 =
      __builtin_shufflevector(r, g, 21, 5, 6, 22, 6, 7, 23, 7, 8, 24, 8, 9, 25, 9, 10, 26);
  const Native t2 =
      __builtin_shufflevector(r, g, 0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0);
  storeNative(
      out, __builtin_shufflevector(t0, b, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15));
  storeNative(out + 16, __builtin_shufflevector(t1, b, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12,
                                                25, 14, 15));
  storeNative(out + 32, __builtin_shufflevector(t2, b, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30,
                                                13, 14, 31));
}

#else

#if defined(__AVX2__)

// Each channel is permuted once so that its values stand where any of the three outputs wants them.
LAMBENT_INLINE void storeInterleaved(float* out, Native red, Native green, Native blue) {
  const __m256 r = _mm256_permutevar8x32_ps((__m256)red, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
  const __m256 g =
      _mm256_permutevar8x32_ps((__m256)green, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
  const __m256 b =
      _mm256_permutevar8x32_ps((__m256)blue, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
  _mm256_storeu_ps(out, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x92), b, 0x24));
  _mm256_storeu_ps(out + 8, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x24), b, 0x49));
  _mm256_storeu_ps(out + 16, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x49), b, 0x92));
}

#else

LAMBENT_INLINE void storeInterleaved(float* out, Native r, Native g, Native b) {
  const Native r0g0r1g1 = __builtin_shufflevector(r, g, 0, 4, 1, 5);
  const Native g1b1g2b2 = __builtin_shufflevector(g, b, 1, 5, 2, 6);
  const Native r3g3r3g3 = __builtin_shufflevector(r, g, 3, 7, 3, 7);
  storeNative(out, __builtin_shufflevector(r0g0r1g1, b, 0, 1, 4, 2));
  storeNative(out + 4, __builtin_shufflevector(g1b1g2b2, r, 0, 1, 6, 2));
  storeNative(out + 8, __builtin_shufflevector(r3g3r3g3, b, 6, 0, 1, 7));
}

#endif

LAMBENT_INLINE void storeInterleaved(float* out, const V& r, const V& g, const V& b) {
  for (int i = 0; i < kParts; ++i)
    storeInterleaved(out + i * 3 * kNative, r.part[i], g.part[i], b.part[i]);
}

#endif

#if defined(__AVX512F__)

// Lanes of several rows are added up together: of two vectors with groups of 2w lanes, the first
// halves of all groups plus the second halves are one vector with groups of w lanes.
template <int kWidth>
LAMBENT_INLINE Native pairwise(Native a, Native b);
template <>
LAMBENT_INLINE Native pairwise<8>(Native a, Native b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23) +
         __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30,
                                 31);
}
template <>
LAMBENT_INLINE Native pairwise<4>(Native a, Native b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27) +
         __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
}
template <>
LAMBENT_INLINE Native pairwise<2>(Native a, Native b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21, 24, 25, 28, 29) +
         __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15, 18, 19, 22, 23, 26, 27, 30, 31);
}
template <>
LAMBENT_INLINE Native pairwise<1>(Native a, Native b) {
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30) +
         __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}

#endif

}  // namespace
}  // namespace LAMBENT_ISA
}  // namespace lambent::shade
