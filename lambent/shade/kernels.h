// The inner loops of shading, compiled once for each instruction set (lambent_isa_kernels). Plain
// declarations only: this header is included by code that is compiled for several machines.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lambent::shade {

inline constexpr int kBlock = 16;  ///< receivers side by side in a block of diffuse transfer

/// Diffuse transfer in blocks: [block][coefficient][channel][kBlock]. `stride` coefficients are
/// stored, the first `count` are used. light: [coefficient][3]. out: 3·kBlock floats for each
/// block, RGB of receiver after receiver.
template <class Number>
using DiffuseKernel = void (*)(const Number* blocks, std::size_t blockCount, int channels,
                               int stride, int count, const float* light, float* out);

/// Matrices, [receiver][channel][rows][columns], times RGB light. light: three vectors of
/// paddedColumns(columns) floats, the padding zero. scratch: channels·rows·columns + kBlock floats.
/// out: [receiver][3][rows]. Bytes count as the integers that they are: scales are the caller's.
template <class Number>
using MatrixKernel = void (*)(const Number* matrices, std::size_t receivers, int channels, int rows,
                              int columns, const float* light, float* scratch, float* out);

constexpr int paddedColumns(int columns) {
  return (columns + kBlock - 1) / kBlock * kBlock;
}

struct Kernels {
  DiffuseKernel<std::uint16_t> diffuseHalf;
  DiffuseKernel<float> diffuseSingle;
  MatrixKernel<std::uint16_t> matrixHalf;
  MatrixKernel<float> matrixSingle;
  MatrixKernel<std::int8_t> matrixByte;
};

namespace baseline {
Kernels kernels();
}
namespace avx2 {
Kernels kernels();
}
namespace avx512 {
Kernels kernels();
}

}  // namespace lambent::shade
