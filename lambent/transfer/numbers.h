// The numbers of transfer: floats as they were simulated, or stored in 8, 16 or 32 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lambent::transfer {

/// What a simulation yields.
using Floats = std::vector<float>;

enum class Encoding { Float16, Float32, Snorm8 };

/// Numbers in one encoding: what is stored and shaded from.
struct Numbers {
  Encoding encoding = Encoding::Float32;
  std::vector<std::uint16_t> half;  ///< IEEE binary16 bits, if Float16
  std::vector<float> single;        ///< if Float32
  /// If Snorm8: −127 … 127, and for every run of `block` of them the value that 127 stands for.
  std::vector<std::int8_t> byte;
  std::vector<float> scales;
  std::size_t block = 0;

  std::size_t size() const {
    switch (encoding) {
      case Encoding::Float16:
        return half.size();
      case Encoding::Snorm8:
        return byte.size();
      case Encoding::Float32:
        break;
    }
    return single.size();
  }
  bool empty() const { return size() == 0; }
};

/// Bytes of one number, without the scales of Snorm8.
constexpr std::size_t bytesPerNumber(Encoding encoding) {
  return encoding == Encoding::Snorm8 ? 1 : encoding == Encoding::Float16 ? 2 : 4;
}
/// Bytes of all of them, scales included.
std::size_t bytesOf(const Numbers& numbers);

/// Rounds to the nearest. `block`, for Snorm8: how many numbers share a scale, their largest
/// magnitude; it divides the number of values.
Numbers encode(std::span<const float> values, Encoding encoding, std::size_t block = 0);
Floats decode(const Numbers& numbers);
/// The same of a stretch of them.
void decode(const Numbers& numbers, std::size_t first, std::span<float> values);

/// √(Σ (decoded − value)² / Σ value²): what an encoding costs. Spans of one length.
double encodingError(std::span<const float> values, const Numbers& numbers);

}  // namespace lambent::transfer
