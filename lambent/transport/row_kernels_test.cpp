#include "lambent/transport/row_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lambent/math/random.h"
#include "lambent/transport/packed_colour.h"

namespace lambent::transport {
namespace {

std::vector<float> noise(std::size_t count, std::uint64_t seed) {
  math::Random random(seed, 0);
  std::vector<float> values(count);
  for (float& v : values) v = 2.0f * random.uniform() - 1.0f;
  return values;
}

TEST(RowKernels, AddRowsIsTheSumOfWeightedRowsForEveryWidth) {
  for (std::size_t stride = 16; stride <= 16 * 14; stride += 16) {
    const std::vector<float> table = noise(50 * stride, stride);
    const std::vector<float> weights = noise(1000, 2);
    math::Random random(3, 0);
    std::vector<std::uint32_t> ids(weights.size());
    for (std::uint32_t& id : ids) id = random.below(50);
    std::vector<double> out(stride, 1.0), expected(stride, 1.0);
    addRows({table.data(), stride}, ids, weights, out.data());
    for (std::size_t r = 0; r < ids.size(); ++r)
      for (std::size_t k = 0; k < stride; ++k)
        expected[k] += double(weights[r]) * table[ids[r] * stride + k];
    for (std::size_t k = 0; k < stride; ++k) EXPECT_NEAR(out[k], expected[k], 1e-4);
  }
}

TEST(RowKernels, AddTintedRowsHasAWeightForEachChannel) {
  for (const std::size_t perChannel : {1u, 4u, 9u, 25u, 64u}) {
    const std::size_t stride = paddedRow(3 * perChannel);
    const std::vector<float> table = noise(50 * stride, stride), weights = noise(3 * 700, 2);
    std::vector<float> masks(3 * stride);
    for (std::size_t k = 0; k < 3 * perChannel; ++k) masks[k / perChannel * stride + k] = 1.0f;
    math::Random random(3, 0);
    std::vector<std::uint32_t> ids(700);
    for (std::uint32_t& id : ids) id = random.below(50);
    std::vector<double> out(stride, 1.0), expected(stride, 1.0);
    addTintedRows({table.data(), stride}, masks, ids, weights, out.data());
    for (std::size_t r = 0; r < ids.size(); ++r)
      for (std::size_t k = 0; k < 3 * perChannel; ++k)
        expected[k] += double(weights[3 * r + k / perChannel]) * table[ids[r] * stride + k];
    for (std::size_t k = 0; k < stride; ++k) EXPECT_NEAR(out[k], expected[k], 1e-4);
  }
}

TEST(PackedColour, IsFinerThanATexture) {
  for (int code = 0; code < 256; ++code) {
    const float linear = std::pow(float(code) / 255.0f, 2.2f);
    const Rgb back = unpackColour(packColour(Rgb(linear, 1.0f - linear, 0.25f)));
    EXPECT_NEAR(std::sqrt(back[0]), std::sqrt(linear), 0.5f / 1023.0f + 1e-6f);
    EXPECT_NEAR(std::sqrt(back[1]), std::sqrt(1.0f - linear), 0.5f / 1023.0f + 1e-6f);
  }
  EXPECT_TRUE((unpackColour(packColour(Rgb(0, 1, 2))) == Rgb(0, 1, 1)).all());
}

TEST(RowKernels, AddOuterProductsIsTheProductOfTheTransposed) {
  for (const std::size_t leftCount : {1u, 4u, 9u, 25u, 81u})
    for (const std::size_t rightStride : {16u, 32u, 48u, 80u}) {
      const std::size_t count = 33, leftStride = paddedRow(leftCount);
      const std::vector<float> left = noise(count * leftStride, 5);
      const std::vector<float> right = noise(count * rightStride, 6);
      std::vector<float> out(leftCount * rightStride, 0.5f);
      addOuterProducts({left.data(), leftStride}, leftCount, {right.data(), rightStride}, count,
                       out.data(), rightStride);
      for (std::size_t i = 0; i < leftCount; ++i)
        for (std::size_t j = 0; j < rightStride; ++j) {
          double expected = 0.5;
          for (std::size_t h = 0; h < count; ++h)
            expected += double(left[h * leftStride + i]) * right[h * rightStride + j];
          EXPECT_NEAR(out[i * rightStride + j], expected, 2e-5);
        }
    }
}

}  // namespace
}  // namespace lambent::transport
