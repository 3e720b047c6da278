// Diffuse: exit radiance (M · L) as a dot product (sloan2002precomputed eq. 8), 16 receivers side
// by side. Glossy: the matrix · vector product of eq. 9, row by row.

#include "lambent/shade/kernels.h"
#include "lambent/shade/wide.h"

namespace lambent::shade {
namespace LAMBENT_ISA {
namespace {

// One block at a time: the processor overlaps the sums of neighbouring blocks by itself, and two
// streams of transfer read at once were slower than one (7.1 → 5.4 kHz for 50,000 receivers × 5
// bands × RGB in 16 bits, AVX-512).
template <int kChannels, class Number>
void shadeBlocks(const Number* blocks, std::size_t blockCount, int stride, int count,
                 const float* light, float* out) {
  const std::size_t blockSize = std::size_t(stride) * kChannels * kBlock;
  for (std::size_t i = 0; i < blockCount; ++i) {
    const Number* at = blocks + i * blockSize;
    V r, g, b;
    for (int k = 0; k < count; ++k, at += kChannels * kBlock) {
      const V mr = load(at);
      const V mg = kChannels == 3 ? load(at + kBlock) : mr;
      const V mb = kChannels == 3 ? load(at + 2 * kBlock) : mr;
      addProduct(r, mr, light[3 * k]);
      addProduct(g, mg, light[3 * k + 1]);
      addProduct(b, mb, light[3 * k + 2]);
    }
    storeInterleaved(out + i * 3 * kBlock, r, g, b);
  }
}

template <class Number>
void diffuse(const Number* blocks, std::size_t blockCount, int channels, int stride, int count,
             const float* light, float* out) {
  if (channels == 3)
    shadeBlocks<3>(blocks, blockCount, stride, count, light, out);
  else
    shadeBlocks<1>(blocks, blockCount, stride, count, light, out);
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
  V r, g, b;
  for (int j = 0; j < columns; j += kBlock) {
    const V m = load(row + j);
    addProduct(r, m, load(light + j));
    if (kChannels == 3) {
      addProduct(g, m, load(light + padded + j));
      addProduct(b, m, load(light + 2 * padded + j));
    }
  }
  sum[0] = r;
  sum[1] = g;
  sum[2] = b;
}

#if defined(__AVX512F__)

template <int kChannels, int kRows, class Number>
LAMBENT_INLINE void multiplyRows(const Number* rows, int columns, const float* light, V (&sum)[3]) {
  if constexpr (kRows == 1) {
    multiplyRow<kChannels>(rows, columns, light, sum);
  } else {
    V a[3], b[3];
    multiplyRows<kChannels, kRows / 2>(rows, columns, light, a);
    multiplyRows<kChannels, kRows / 2>(rows + std::ptrdiff_t(kRows / 2) * columns, columns, light,
                                       b);
    for (int c = 0; c < kChannels; ++c)
      sum[c].part[0] = pairwise<kBlock / kRows>(a[c].part[0], b[c].part[0]);
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
      const Native all = pairwise<1>(sum[c].part[0], sum[c].part[0]);
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
    for (int c = 0; c < kChannels; ++c) out[c * rows + i] = sumOfLanes(sum[c]);
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
  return {diffuse<std::uint16_t>, diffuse<float>, matrix<std::uint16_t>, matrix<float>,
          matrix<std::int8_t>};
}

}  // namespace LAMBENT_ISA
}  // namespace lambent::shade
