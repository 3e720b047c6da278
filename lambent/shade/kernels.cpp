// Diffuse: exit radiance (M · L) as a dot product (sloan2002precomputed eq. 8), 16 receivers side
// by side. Glossy: the matrix · vector product of eq. 9, row by row.
//
// Vectors are GCC's generic ones, 16 floats wide; the compiler splits them where the machine's are
// narrower. Only the conversion from 16-bit floats and the interleaved store are written for each
// instruction set.

#include "lambent/shade/kernels.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#define LAMBENT_INLINE inline __attribute__((always_inline))

namespace lambent::shade {
namespace LAMBENT_ISA {
namespace {

typedef float V __attribute__((vector_size(64)));
typedef float VUnaligned __attribute__((vector_size(64), aligned(4)));
typedef float V8 __attribute__((vector_size(32)));
typedef float V4 __attribute__((vector_size(16)));

LAMBENT_INLINE V load(const float* p) {
  return *reinterpret_cast<const VUnaligned*>(p);
}

LAMBENT_INLINE void store(float* p, V v) {
  *reinterpret_cast<VUnaligned*>(p) = v;
}

#if defined(__AVX512F__)

LAMBENT_INLINE V load(const std::uint16_t* p) {
  return (V)_mm512_maskz_cvtph_ps(__mmask16(-1),
                                  _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
}

#elif defined(__F16C__)

LAMBENT_INLINE V load(const std::uint16_t* p) {
  const V8 a = (V8)_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
  const V8 b = (V8)_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p + 8)));
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

#else

// By integers, so that a machine set to flush denormals still reads small halves.
LAMBENT_INLINE V load(const std::uint16_t* p) {
  typedef std::int32_t I __attribute__((vector_size(64)));
  I h;
  for (int i = 0; i < kBlock; ++i) h[i] = p[i];
  const I sign = (h & 0x8000) << 16, exponent = h & 0x7c00, mantissa = h & 0x03ff;
  const I normal = ((h & 0x7fff) << 13) + (112 << 23);
  const I special = ((h & 0x7fff) << 13) | 0x7f800000;
  const I small = (I)(__builtin_convertvector(mantissa, V) * 0x1p-24f);
  const I isSmall = exponent == 0, isSpecial = exponent == 0x7c00;
  return (V)(sign | (isSmall & small) | (isSpecial & special) | (~(isSmall | isSpecial) & normal));
}

#endif

// r0 … r15, g0 … g15, b0 … b15 → r0 g0 b0 r1 g1 b1 …
#if defined(__AVX512F__)

LAMBENT_INLINE void storeInterleaved(float* out, V r, V g, V b) {
  // First red and green into their places, then blue: index 16 + i takes the second operand's i.
  const V t0 = __builtin_shufflevector(r, g, 0, 16, 0, 1, 17, 1, 2, 18, 2, 3, 19, 3, 4, 20, 4, 5);
  const V t1 = __builtin_shufflevector(r, g, 21, 5, 6, 22, 6, 7, 23, 7, 8, 24, 8, 9, 25, 9, 10, 26);
  const V t2 =
      __builtin_shufflevector(r, g, 0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0);
  store(out,
        __builtin_shufflevector(t0, b, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15));
  store(out + 16,
        __builtin_shufflevector(t1, b, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15));
  store(out + 32,
        __builtin_shufflevector(t2, b, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31));
}

#elif defined(__AVX2__)

// Each channel is permuted once so that its values stand where any of the three outputs wants them.
LAMBENT_INLINE void storeInterleaved8(float* out, V8 red, V8 green, V8 blue) {
  const __m256 r = _mm256_permutevar8x32_ps((__m256)red, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
  const __m256 g =
      _mm256_permutevar8x32_ps((__m256)green, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
  const __m256 b =
      _mm256_permutevar8x32_ps((__m256)blue, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
  _mm256_storeu_ps(out, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x92), b, 0x24));
  _mm256_storeu_ps(out + 8, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x24), b, 0x49));
  _mm256_storeu_ps(out + 16, _mm256_blend_ps(_mm256_blend_ps(r, g, 0x49), b, 0x92));
}

LAMBENT_INLINE void storeInterleaved(float* out, V r, V g, V b) {
  storeInterleaved8(out, __builtin_shufflevector(r, r, 0, 1, 2, 3, 4, 5, 6, 7),
                    __builtin_shufflevector(g, g, 0, 1, 2, 3, 4, 5, 6, 7),
                    __builtin_shufflevector(b, b, 0, 1, 2, 3, 4, 5, 6, 7));
  storeInterleaved8(out + 24, __builtin_shufflevector(r, r, 8, 9, 10, 11, 12, 13, 14, 15),
                    __builtin_shufflevector(g, g, 8, 9, 10, 11, 12, 13, 14, 15),
                    __builtin_shufflevector(b, b, 8, 9, 10, 11, 12, 13, 14, 15));
}

#else

LAMBENT_INLINE void storeInterleaved(float* out, V r, V g, V b) {
  for (int i = 0; i < kBlock; ++i) {
    out[3 * i] = r[i];
    out[3 * i + 1] = g[i];
    out[3 * i + 2] = b[i];
  }
}

#endif

// Several blocks at once, so that their chains of additions hide each other's latency.
template <int kChannels, int kTogether, class Number>
LAMBENT_INLINE void shadeTogether(const Number* blocks, int stride, int count, const float* light,
                                  float* out) {
  const std::ptrdiff_t blockSize = std::ptrdiff_t(stride) * kChannels * kBlock;
  V sum[kTogether][3] = {};
  for (int k = 0; k < count; ++k) {
    const float r = light[3 * k], g = light[3 * k + 1], b = light[3 * k + 2];
    for (int t = 0; t < kTogether; ++t) {
      const Number* at = blocks + t * blockSize + std::ptrdiff_t(k) * kChannels * kBlock;
      const V mr = load(at);
      const V mg = kChannels == 3 ? load(at + kBlock) : mr;
      const V mb = kChannels == 3 ? load(at + 2 * kBlock) : mr;
      sum[t][0] += mr * r;
      sum[t][1] += mg * g;
      sum[t][2] += mb * b;
    }
  }
  for (int t = 0; t < kTogether; ++t)
    storeInterleaved(out + t * 3 * kBlock, sum[t][0], sum[t][1], sum[t][2]);
}

template <int kChannels, class Number>
void shadeBlocks(const Number* blocks, std::size_t blockCount, int stride, int count,
                 const float* light, float* out) {
#if defined(__AVX512F__)
  constexpr int kTogether = 2;
#else
  constexpr int kTogether = 1;  // 16 registers hold one block's sums
#endif
  const std::size_t blockSize = std::size_t(stride) * kChannels * kBlock;
  std::size_t i = 0;
  for (; i + kTogether <= blockCount; i += kTogether)
    shadeTogether<kChannels, kTogether>(blocks + i * blockSize, stride, count, light,
                                        out + i * 3 * kBlock);
  for (; i < blockCount; ++i)
    shadeTogether<kChannels, 1>(blocks + i * blockSize, stride, count, light, out + i * 3 * kBlock);
}

template <class Number>
void diffuse(const Number* blocks, std::size_t blockCount, int channels, int stride, int count,
             const float* light, float* out) {
  if (channels == 3)
    shadeBlocks<3>(blocks, blockCount, stride, count, light, out);
  else
    shadeBlocks<1>(blocks, blockCount, stride, count, light, out);
}

LAMBENT_INLINE V4 foldToFour(V v) {
  const V8 a = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
               __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  return __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

template <class Number>
LAMBENT_INLINE void decode(const Number* in, int count, float* out) {
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) store(out + i, load(in + i));
  if (i < count) {
    Number tail[kBlock] = {};
    for (int k = 0; i + k < count; ++k) tail[k] = in[i + k];
    store(out + i, load(tail));
  }
}

// What one row gives before its 16 lanes are added up. Rows are read 16 numbers at a time past
// their ends: what lies there meets the light's zeros.
template <int kChannels, class Number>
LAMBENT_INLINE void multiplyRow(const Number* row, int columns, const float* light, V (&sum)[3]) {
  const int padded = paddedColumns(columns);
  V r = {}, g = {}, b = {};
  for (int j = 0; j < columns; j += kBlock) {
    const V m = load(row + j);
    r += m * load(light + j);
    if (kChannels == 3) {
      g += m * load(light + padded + j);
      b += m * load(light + 2 * padded + j);
    }
  }
  sum[0] = r;
  sum[1] = g;
  sum[2] = b;
}

#if defined(__AVX512F__)

// Lanes of several rows are added up together: of two vectors with groups of 2w lanes, the first
// halves of all groups plus the second halves are one vector with groups of w lanes.
template <int kWidth>
LAMBENT_INLINE V pairwise(V a, V b);
template <>
LAMBENT_INLINE V pairwise<8>(V a, V b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23) +
         __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30,
                                 31);
}
template <>
LAMBENT_INLINE V pairwise<4>(V a, V b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27) +
         __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31);
}
template <>
LAMBENT_INLINE V pairwise<2>(V a, V b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21, 24, 25, 28, 29) +
         __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15, 18, 19, 22, 23, 26, 27, 30, 31);
}
template <>
LAMBENT_INLINE V pairwise<1>(V a, V b) {
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30) +
         __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}

template <int kChannels, int kRows, class Number>
LAMBENT_INLINE void multiplyRows(const Number* rows, int columns, const float* light, V (&sum)[3]) {
  if constexpr (kRows == 1) {
    multiplyRow<kChannels>(rows, columns, light, sum);
  } else {
    V a[3], b[3];
    multiplyRows<kChannels, kRows / 2>(rows, columns, light, a);
    multiplyRows<kChannels, kRows / 2>(rows + std::ptrdiff_t(kRows / 2) * columns, columns, light,
                                       b);
    for (int c = 0; c < kChannels; ++c) sum[c] = pairwise<kBlock / kRows>(a[c], b[c]);
  }
}

/// The first rows, as many as can be done 16 or 8 at a time.
template <int kChannels, class Number>
LAMBENT_INLINE int multiplyGroups(const Number* matrix, int rows, int columns, const float* light,
                                  float* out) {
  int i = 0;
  V sum[3];
  for (; i + 16 <= rows; i += 16) {
    multiplyRows<kChannels, 16>(matrix + std::ptrdiff_t(i) * columns, columns, light, sum);
    for (int c = 0; c < kChannels; ++c) store(out + c * rows + i, sum[c]);
  }
  for (; i + 8 <= rows; i += 8) {
    multiplyRows<kChannels, 8>(matrix + std::ptrdiff_t(i) * columns, columns, light, sum);
    for (int c = 0; c < kChannels; ++c) {
      const V all = pairwise<1>(sum[c], sum[c]);
      const V8 eight = __builtin_shufflevector(all, all, 0, 1, 2, 3, 4, 5, 6, 7);
      _mm256_storeu_ps(out + c * rows + i, (__m256)eight);
    }
  }
  return i;
}

#else

template <int kChannels, class Number>
LAMBENT_INLINE int multiplyGroups(const Number*, int, int, const float*, float*) {
  return 0;
}

#endif

/// out: kChannels vectors of `rows` results, one for each of the light's vectors.
template <int kChannels, class Number>
LAMBENT_INLINE void multiply(const Number* matrix, int rows, int columns, const float* light,
                             float* out) {
  for (int i = multiplyGroups<kChannels>(matrix, rows, columns, light, out); i < rows; ++i) {
    V sum[3];
    multiplyRow<kChannels>(matrix + std::ptrdiff_t(i) * columns, columns, light, sum);
    for (int c = 0; c < kChannels; ++c) {
      const V4 four = foldToFour(sum[c]);
      out[c * rows + i] = (four[0] + four[2]) + (four[1] + four[3]);
    }
  }
}

template <class Number>
LAMBENT_INLINE void multiplyReceiver(const Number* matrices, int channels, int rows, int columns,
                                     const float* light, float* out) {
  if (channels == 1) {
    multiply<3>(matrices, rows, columns, light, out);
  } else {
    for (int c = 0; c < 3; ++c)
      multiply<1>(matrices + std::ptrdiff_t(c) * rows * columns, rows, columns,
                  light + c * paddedColumns(columns), out + c * rows);
  }
}

template <class Number>
void matrix(const Number* matrices, std::size_t receivers, int channels, int rows, int columns,
            const float* light, float* scratch, float* out) {
  const int size = channels * rows * columns;
  std::size_t p = 0;
  for (; (receivers - p) * size >= std::size_t(size) + kBlock; ++p)
    multiplyReceiver(matrices + p * size, channels, rows, columns, light, out + p * 3 * rows);
  // The last ones from where reading past their ends is allowed.
  for (; p < receivers; ++p) {
    decode(matrices + p * size, size, scratch);
    for (int i = 0; i < kBlock; ++i) scratch[size + i] = 0.0f;
    multiplyReceiver(static_cast<const float*>(scratch), channels, rows, columns, light,
                     out + p * 3 * rows);
  }
}

}  // namespace

Kernels kernels() {
  return {diffuse<std::uint16_t>, diffuse<float>, matrix<std::uint16_t>, matrix<float>};
}

}  // namespace LAMBENT_ISA
}  // namespace lambent::shade
