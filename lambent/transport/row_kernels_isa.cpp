// Compiled once for each instruction set with LAMBENT_ISA as the namespace. GCC's vector extension
// becomes one 512-bit, two 256-bit or four 128-bit operations.
#include <stddef.h>
#include <stdint.h>

namespace lambent::transport::LAMBENT_ISA {

typedef float Lane16 __attribute__((vector_size(64), aligned(4)));

namespace {

constexpr size_t kUnit = 16;
constexpr size_t kBlock = 128;   // rows summed in single precision
constexpr size_t kPrefetch = 6;  // rows ahead; tables are larger than the inner caches

template <int kUnits>
void addRowsStrip(const float* rows, size_t stride, const uint32_t* ids, const float* weights,
                  size_t count, double* out) {
  for (size_t begin = 0; begin < count; begin += kBlock) {
    const size_t end = begin + kBlock < count ? begin + kBlock : count;
    Lane16 sum[kUnits] = {};
    for (size_t r = begin; r < end; ++r) {
      if (r + kPrefetch < count) {
        const float* ahead = rows + ids[r + kPrefetch] * stride;
        for (int k = 0; k < kUnits; ++k) __builtin_prefetch(ahead + k * kUnit);
      }
      const float* row = rows + ids[r] * stride;
      const float weight = weights[r];
      for (int k = 0; k < kUnits; ++k)
        sum[k] += weight * *reinterpret_cast<const Lane16*>(row + k * kUnit);
    }
    for (int k = 0; k < kUnits; ++k)
      for (size_t j = 0; j < kUnit; ++j) out[k * kUnit + j] += static_cast<double>(sum[k][j]);
  }
}

void addTintedUnit(const float* rows, size_t stride, const Lane16 (&mask)[3], const uint32_t* ids,
                   const float* weights, size_t count, double* out) {
  for (size_t begin = 0; begin < count; begin += kBlock) {
    const size_t end = begin + kBlock < count ? begin + kBlock : count;
    Lane16 sum = {};
    for (size_t r = begin; r < end; ++r) {
      if (r + kPrefetch < count) __builtin_prefetch(rows + ids[r + kPrefetch] * stride);
      const float* w = weights + 3 * r;
      const Lane16 tint = w[0] * mask[0] + w[1] * mask[1] + w[2] * mask[2];
      sum += tint * *reinterpret_cast<const Lane16*>(rows + ids[r] * stride);
    }
    for (size_t j = 0; j < kUnit; ++j) out[j] += static_cast<double>(sum[j]);
  }
}

template <int kLeft>
void addOuterStrip(const float* left, size_t leftStride, const float* right, size_t rightStride,
                   size_t count, float* out, size_t outStride) {
  Lane16 sum[kLeft][2] = {};
  for (size_t h = 0; h < count; ++h) {
    const Lane16 r0 = *reinterpret_cast<const Lane16*>(right + h * rightStride);
    const Lane16 r1 = *reinterpret_cast<const Lane16*>(right + h * rightStride + kUnit);
    for (int i = 0; i < kLeft; ++i) {
      const float l = left[h * leftStride + i];
      sum[i][0] += l * r0;
      sum[i][1] += l * r1;
    }
  }
  for (int i = 0; i < kLeft; ++i)
    for (int k = 0; k < 2; ++k)
      *reinterpret_cast<Lane16*>(out + i * outStride + k * kUnit) += sum[i][k];
}

template <int kLeft>
void addOuterStripNarrow(const float* left, size_t leftStride, const float* right,
                         size_t rightStride, size_t count, float* out, size_t outStride) {
  Lane16 sum[kLeft] = {};
  for (size_t h = 0; h < count; ++h) {
    const Lane16 r = *reinterpret_cast<const Lane16*>(right + h * rightStride);
    for (int i = 0; i < kLeft; ++i) sum[i] += left[h * leftStride + i] * r;
  }
  for (int i = 0; i < kLeft; ++i) *reinterpret_cast<Lane16*>(out + i * outStride) += sum[i];
}

template <int kLeft>
void addOuterColumns(const float* left, size_t leftStride, const float* right, size_t rightStride,
                     size_t count, float* out, size_t outStride) {
  size_t j = 0;
  for (; j + 2 * kUnit <= rightStride; j += 2 * kUnit)
    addOuterStrip<kLeft>(left, leftStride, right + j, rightStride, count, out + j, outStride);
  if (j < rightStride)
    addOuterStripNarrow<kLeft>(left, leftStride, right + j, rightStride, count, out + j, outStride);
}

}  // namespace

void addRows(const float* rows, size_t stride, const uint32_t* ids, const float* weights,
             size_t count, double* out) {
  const size_t units = stride / kUnit;
  size_t k = 0;
  for (; k + 6 <= units; k += 6)
    addRowsStrip<6>(rows + k * kUnit, stride, ids, weights, count, out + k * kUnit);
  const float* rest = rows + k * kUnit;
  double* restOut = out + k * kUnit;
  switch (units - k) {
    case 1:
      return addRowsStrip<1>(rest, stride, ids, weights, count, restOut);
    case 2:
      return addRowsStrip<2>(rest, stride, ids, weights, count, restOut);
    case 3:
      return addRowsStrip<3>(rest, stride, ids, weights, count, restOut);
    case 4:
      return addRowsStrip<4>(rest, stride, ids, weights, count, restOut);
    case 5:
      return addRowsStrip<5>(rest, stride, ids, weights, count, restOut);
    default:
      return;
  }
}

void addTintedRows(const float* rows, size_t stride, const float* masks, const uint32_t* ids,
                   const float* weights, size_t count, double* out) {
  for (size_t k = 0; k < stride; k += kUnit) {
    Lane16 mask[3];
    for (size_t c = 0; c < 3; ++c)
      mask[c] = *reinterpret_cast<const Lane16*>(masks + c * stride + k);
    addTintedUnit(rows + k, stride, mask, ids, weights, count, out + k);
  }
}

void addOuterProducts(const float* left, size_t leftStride, size_t leftCount, const float* right,
                      size_t rightStride, size_t count, float* out, size_t outStride) {
  size_t i = 0;
  for (; i + 6 <= leftCount; i += 6)
    addOuterColumns<6>(left + i, leftStride, right, rightStride, count, out + i * outStride,
                       outStride);
  for (; i < leftCount; ++i)
    addOuterColumns<1>(left + i, leftStride, right, rightStride, count, out + i * outStride,
                       outStride);
}

}  // namespace lambent::transport::LAMBENT_ISA
