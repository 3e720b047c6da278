// Sums of weighted rows: what all of a bake's arithmetic comes down to. Compiled for several
// instruction sets; see row_kernels_isa.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lambent::transport {

/// Rows are padded to whole multiples of this many floats.
inline constexpr std::size_t kRowUnit = 16;
constexpr std::size_t paddedRow(std::size_t count) {
  return (count + kRowUnit - 1) / kRowUnit * kRowUnit;
}

/// A table of rows: row i starts at data + i·stride; stride is a multiple of kRowUnit.
struct Rows {
  const float* data = nullptr;
  std::size_t stride = 0;
};

/// out[k] += Σ_r weights[r] · rows[ids[r]][k] for k < rows.stride. Sums of 128 rows are kept in
/// single precision, sums of those in double.
void addRows(Rows rows, std::span<const std::uint32_t> ids, std::span<const float> weights,
             double* out);

/// The same with three weights a row, one for each channel: out[k] += Σ_r (Σ_c weights[3r + c] ·
/// masks[c·stride + k]) · rows[ids[r]][k]. masks[c] is 1 where k belongs to channel c, 0 elsewhere.
void addTintedRows(Rows rows, std::span<const float> masks, std::span<const std::uint32_t> ids,
                   std::span<const float> weights, double* out);

/// out[i·outStride + j] += Σ_h left[h][i] · right[h][j] for i < leftCount, j < right.stride: the
/// product Leftᵀ·Right over `count` rows of both.
void addOuterProducts(Rows left, std::size_t leftCount, Rows right, std::size_t count, float* out,
                      std::size_t outStride);

}  // namespace lambent::transport
