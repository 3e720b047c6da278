// 16-bit floats (IEEE 754 binary16): 1 sign, 5 exponent, 10 significand bits; 11 bits of precision
// from 6.1e-5 to 65504, subnormals down to 6e-8.
//
// The two functions here are the definition, in integer arithmetic that no rounding mode or
// flush-to-zero setting touches. The block functions give the same bits with the machine's own
// instructions where it has them.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace lambent::transfer {

inline constexpr float kLargestHalf = 65504.0f;

/// The nearest half; ties go to the even significand. What is finite and beyond ±65504 becomes
/// ±65504 (IEEE would say infinity: one outlier should not turn a whole dot product into NaN).
/// Infinities stay; NaNs stay, quiet, with the upper bits of their payload.
constexpr std::uint16_t halfFromFloat(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return std::uint16_t(sign | 0x7e00u | ((magnitude >> 13) & 0x3ffu));
  if (magnitude == 0x7f800000u) return std::uint16_t(sign | 0x7c00u);
  if (magnitude >= 0x477fe000u) return std::uint16_t(sign | 0x7bffu);  // 65504 and more
  if (magnitude >= 0x38800000u) {  // 2^-14 and more: normal. Rebias 127 → 15, drop 13 bits
    const std::uint32_t odd = (magnitude >> 13) & 1u;
    return std::uint16_t(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
  }
  if (magnitude <= 0x33000000u) return std::uint16_t(sign);  // 2^-25 and less: the tie goes to 0
  // Subnormal: the significand with its leading one, in units of 2^-24.
  const std::uint32_t significand = (magnitude & 0x7fffffu) | 0x800000u;
  const std::uint32_t shift = 126u - (magnitude >> 23);  // 14 … 24
  const std::uint32_t kept = significand >> shift;
  const std::uint32_t rest = significand & ((1u << shift) - 1u), tie = 1u << (shift - 1u);
  return std::uint16_t(sign | (kept + (rest > tie || (rest == tie && (kept & 1u)) ? 1u : 0u)));
}

/// Exact. Signalling NaNs come out quiet.
constexpr float floatFromHalf(std::uint16_t half) {
  const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
  const std::uint32_t exponent = (half >> 10) & 0x1fu;
  std::uint32_t significand = half & 0x3ffu;
  if (exponent == 31u) {
    const std::uint32_t quiet = significand ? 0x400000u : 0u;
    return std::bit_cast<float>(sign | 0x7f800000u | quiet | (significand << 13));
  }
  if (exponent > 0u)
    return std::bit_cast<float>(sign | ((exponent + 112u) << 23) | (significand << 13));
  if (significand == 0u) return std::bit_cast<float>(sign);
  const std::uint32_t shift = std::uint32_t(std::countl_zero(significand)) - 21u;  // 1 … 10
  significand = (significand << shift) & 0x3ffu;
  return std::bit_cast<float>(sign | ((113u - shift) << 23) | (significand << 13));
}

/// Whole blocks; both spans of one size. Bit for bit what the functions above give.
void halvesFromFloats(std::span<const float> values, std::span<std::uint16_t> halves);
void floatsFromHalves(std::span<const std::uint16_t> halves, std::span<float> values);

}  // namespace lambent::transfer
