#include "lambent/transfer/numbers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "lambent/transfer/half.h"

namespace lambent::transfer {

namespace {
constexpr float kSnorm8One = 127.0f;  ///< as OpenGL's signed normalised bytes
}

std::size_t bytesOf(const Numbers& numbers) {
  return numbers.size() * bytesPerNumber(numbers.encoding) + numbers.scales.size() * sizeof(float);
}

Numbers encode(std::span<const float> values, Encoding encoding, std::size_t block) {
  Numbers numbers;
  numbers.encoding = encoding;
  switch (encoding) {
    case Encoding::Float16:
      numbers.half.resize(values.size());
      halvesFromFloats(values, numbers.half);
      break;
    case Encoding::Float32:
      numbers.single.assign(values.begin(), values.end());
      break;
    case Encoding::Snorm8:
      if (values.empty()) break;
      assert(block > 0 && values.size() % block == 0);
      numbers.block = block;
      numbers.byte.resize(values.size());
      numbers.scales.resize(values.size() / block);
      for (std::size_t b = 0; b < numbers.scales.size(); ++b) {
        const std::span<const float> run = values.subspan(b * block, block);
        float largest = 0.0f;
        for (const float value : run) largest = std::max(largest, std::abs(value));
        numbers.scales[b] = largest;
        const float perUnit = largest > 0.0f ? kSnorm8One / largest : 0.0f;
        for (std::size_t i = 0; i < block; ++i)
          numbers.byte[b * block + i] = static_cast<std::int8_t>(std::lround(run[i] * perUnit));
      }
      break;
  }
  return numbers;
}

void decode(const Numbers& numbers, std::size_t first, std::span<float> values) {
  assert(first + values.size() <= numbers.size());
  switch (numbers.encoding) {
    case Encoding::Float16:
      floatsFromHalves(std::span(numbers.half).subspan(first, values.size()), values);
      break;
    case Encoding::Float32:
      std::copy_n(numbers.single.begin() + std::ptrdiff_t(first), values.size(), values.begin());
      break;
    case Encoding::Snorm8:
      for (std::size_t i = 0; i < values.size();) {
        const std::size_t block = (first + i) / numbers.block;
        const std::size_t end = std::min(values.size(), (block + 1) * numbers.block - first);
        const float unit = numbers.scales[block] / kSnorm8One;
        for (; i < end; ++i) values[i] = unit * static_cast<float>(numbers.byte[first + i]);
      }
      break;
  }
}

Floats decode(const Numbers& numbers) {
  Floats values(numbers.size());
  decode(numbers, 0, values);
  return values;
}

double encodingError(std::span<const float> values, const Numbers& numbers) {
  assert(values.size() == numbers.size());
  const std::vector<float> decoded = decode(numbers);
  double error = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double difference = double(decoded[i]) - values[i];
    error += difference * difference;
    whole += double(values[i]) * values[i];
  }
  return whole > 0.0 ? std::sqrt(error / whole) : 0.0;
}

}  // namespace lambent::transfer
