// This work is based on:
// - ivanic1996rotation: the explicit matrix (rotation_tables.h).
// - sloan2002precomputed: the rotation of one vector, in rotation_kernel.cpp.
#include "lambent/sh/rotation.h"

#include <algorithm>
#include <cassert>

#include "lambent/math/isa.h"
#include "lambent/sh/rotation_kernel.h"
#include "lambent/sh/rotation_tables.h"

namespace lambent::sh {

namespace {

RotationKernels bestKernels() {
  switch (math::bestIsa()) {
#if defined(__x86_64__)
    case math::Isa::Avx512:
      return avx512::rotationKernels();
    case math::Isa::Avx2:
      return avx2::rotationKernels();
#endif
    default:
      return baseline::rotationKernels();
  }
}

[[maybe_unused]] bool isRotation(const Mat3d& q, double tolerance) {
  const Mat3d excess = q.transpose() * q - Mat3d::Identity();
  const double determinant = q(0, 0) * (q(1, 1) * q(2, 2) - q(1, 2) * q(2, 1)) -
                             q(0, 1) * (q(1, 0) * q(2, 2) - q(1, 2) * q(2, 0)) +
                             q(0, 2) * (q(1, 0) * q(2, 1) - q(1, 1) * q(2, 0));
  return excess.cwiseAbs().maxCoeff() <= tolerance && determinant > 0;
}

}  // namespace

void rotate(int bands, const Mat3& q, std::span<const float> in, std::span<float> out) {
  assert(bands >= 1 && bands <= kMaxBands);
  assert(in.size() >= std::size_t(coefficientCount(bands)));
  assert(out.size() >= std::size_t(coefficientCount(bands)));
  assert(isRotation(q.cast<double>(), 1e-4));
  static const RotationKernels kernels = bestKernels();
  kernels.forBands[bands](q.data(), in.data(), out.data());
}

RgbCoefficients rotate(const Mat3& dstFromSrc, const RgbCoefficients& f) {
  RgbCoefficients result(f.bands);
  for (int c = 0; c < 3; ++c) rotate(f.bands, dstFromSrc, f.channel(c), result.channel(c));
  return result;
}

std::vector<double> rotationMatrix(int bands, const Mat3d& q) {
  assert(bands >= 1 && bands <= kTableBands);
  assert(isRotation(q, 1e-4));
  constexpr int kAxis[3] = {1, 2, 0};  // band 1 is over (y, z, x)
  double band1[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) band1[i * 3 + j] = q(kAxis[i], kAxis[j]);
  const int count = coefficientCount(bands);
  std::vector<double> matrix(std::size_t(count) * std::size_t(count), 0.0);
  std::vector<double> below, block{1.0};
  matrix[0] = 1;
  for (int l = 1; l < bands; ++l) {
    const int width = 2 * l + 1, first = l * l;
    below.swap(block);
    block.resize(std::size_t(width * width));
    rotationOfNextBand(l, band1, below.data(), block.data());
    for (int i = 0; i < width; ++i)
      std::copy_n(block.begin() + i * width, width,
                  matrix.begin() + std::ptrdiff_t(first + i) * count + first);
  }
  return matrix;
}

}  // namespace lambent::sh
