// The product M L of sloan2002precomputed eq. 9 and sloan2003biscale eq. 4 over all receivers, by
// the kernels of this machine.

#include "lambent/shade/transfer_matrices.h"

#include <algorithm>
#include <cassert>

#include "lambent/shade/dispatch.h"
#include "lambent/work/parallel_for.h"

namespace lambent::shade {

using transfer::Encoding;
using transfer::Numbers;

namespace {

constexpr float kSnorm8One = 127.0f;

/// Whether every row lies within one run of a scale: then products of bytes are scaled, which are
/// fewer than the bytes.
bool scalesAreOfRows(const Numbers& matrices, int columns) {
  return matrices.block % std::size_t(columns) == 0;
}

void scaleRows(const transfer::Matrices<Numbers>& matrices, std::size_t receiver, float* product) {
  const std::size_t columns = std::size_t(sh::coefficientCount(matrices.inBands));
  const std::size_t rows = std::size_t(sh::coefficientCount(matrices.outBands));
  for (int c = 0; c < 3; ++c) {
    const std::size_t matrix = receiver * matrices.channels + (matrices.channels == 3 ? c : 0);
    for (std::size_t i = 0; i < rows; ++i)
      product[c * rows + i] *=
          matrices.numbers.scales[(matrix * rows + i) * columns / matrices.numbers.block] /
          kSnorm8One;
  }
}

}  // namespace

std::vector<float> applyMatrices(const transfer::Matrices<Numbers>& whole,
                                 const sh::RgbCoefficients& light) {
  const Numbers& matrices = whole.numbers;
  const int rows = sh::coefficientCount(whole.outBands);
  const int columns = sh::coefficientCount(whole.inBands), channels = whole.channels;
  const int padded = paddedColumns(columns);
  const std::size_t size = std::size_t(channels) * rows * columns;
  assert(channels == 1 || channels == 3);
  assert(matrices.size() % size == 0);
  const std::size_t receivers = matrices.size() / size;

  std::vector<float> padLight(3 * std::size_t(padded));
  const int count = std::min(columns, sh::coefficientCount(light.bands));
  for (int c = 0; c < 3; ++c)
    std::copy_n(light.channel(c).begin(), count, padLight.begin() + c * padded);

  const Kernels kernels = kernelsFor(math::bestIsa());
  std::vector<float> out(receivers * 3 * rows);
  const auto run = [&](std::size_t begin, std::size_t end) {
    std::vector<float> scratch(size + kBlock);
    float* at = out.data() + begin * 3 * rows;
    switch (matrices.encoding) {
      case Encoding::Float16:
        kernels.matrixHalf(matrices.half.data() + begin * size, end - begin, channels, rows,
                           columns, padLight.data(), scratch.data(), at);
        break;
      case Encoding::Float32:
        kernels.matrixSingle(matrices.single.data() + begin * size, end - begin, channels, rows,
                             columns, padLight.data(), scratch.data(), at);
        break;
      case Encoding::Snorm8:
        if (scalesAreOfRows(matrices, columns)) {
          kernels.matrixByte(matrices.byte.data() + begin * size, end - begin, channels, rows,
                             columns, padLight.data(), scratch.data(), at);
          for (std::size_t p = begin; p < end; ++p, at += 3 * rows) scaleRows(whole, p, at);
        } else {
          std::vector<float> decoded(size);
          for (std::size_t p = begin; p < end; ++p, at += 3 * rows) {
            transfer::decode(matrices, p * size, decoded);
            kernels.matrixSingle(decoded.data(), 1, channels, rows, columns, padLight.data(),
                                 scratch.data(), at);
          }
        }
        break;
    }
  };
  work::parallelRanges(receivers, 256,
                       [&](std::size_t begin, std::size_t end) { run(begin, end); });
  return out;
}

}  // namespace lambent::shade
