// This work is based on:
// - swinbank2006fibonacci: Fibonacci grids on the sphere.
// - burley2020practical: hash-based Owen scrambling, with the Laine-Karras permutation whose
//   constants are those of §3.2; the Sobol matrices of the first two dimensions are the bit
//   reversal and Pascal's triangle modulo 2.
// - roberts2018unreasonable: the R2 sequence.
#include "lambent/math/sequences.h"

#include <cassert>
#include <cmath>

#include "lambent/math/random.h"

namespace lambent::math {

std::vector<Vec3> sphericalFibonacci(int count) {
  assert(count >= 0);
  constexpr double kGoldenFraction = 0.61803398874989484820;
  std::vector<Vec3> directions(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const double turns = i * kGoldenFraction;
    const double azimuth = 2 * kPi * (turns - std::floor(turns));
    const double sine = std::sqrt(1 - z * z);
    directions[static_cast<std::size_t>(i)] =
        Vec3d(sine * std::cos(azimuth), sine * std::sin(azimuth), z).cast<float>();
  }
  return directions;
}

static std::uint32_t reverseBits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

/// Every output bit depends on the input bits below it alone: reversed, an Owen scrambling.
static std::uint32_t laineKarras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

static std::uint32_t owenScramble(std::uint32_t x, std::uint32_t seed) {
  return reverseBits(laineKarras(reverseBits(x), seed));
}

/// Row i of Pascal's triangle modulo 2, mirrored, gives the direction numbers of Sobol's second
/// dimension: v_{i+1} = v_i ^ (v_i >> 1).
static std::uint32_t sobolSecondDimension(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 0x80000000u; index != 0; index >>= 1, v ^= v >> 1)
    if (index & 1) result ^= v;
  return result;
}

Vec2 sobol2(std::uint32_t index, std::uint32_t seed) {
  const std::uint64_t key = mix64(0x9e3779b97f4a7c15u + seed);
  const auto shuffle = static_cast<std::uint32_t>(key);
  const auto key2 = mix64(key);
  const std::uint32_t i = owenScramble(index, shuffle);
  const std::uint32_t x = owenScramble(reverseBits(i), static_cast<std::uint32_t>(key2));
  const std::uint32_t y =
      owenScramble(sobolSecondDimension(i), static_cast<std::uint32_t>(key2 >> 32));
  return Vec2(static_cast<float>(x >> 8), static_cast<float>(y >> 8)) * 0x1p-24f;
}

Vec2 r2(std::uint32_t index, const Vec2& offset) {
  constexpr double kPlastic = 1.32471795724474602596;
  const double x = offset.x() + index * (1 / kPlastic);
  const double y = offset.y() + index * (1 / (kPlastic * kPlastic));
  // A double just below 1 may round to 1 as a float.
  const auto fraction = [](double v) {
    return static_cast<float>(std::floor((v - std::floor(v)) * 0x1p24) * 0x1p-24);
  };
  return Vec2(fraction(x), fraction(y));
}

double radicalInverse(std::uint32_t base, std::uint64_t index) {
  assert(base >= 2);
  double result = 0, scale = 1.0 / base;
  for (; index != 0; index /= base, scale /= base)
    result += static_cast<double>(index % base) * scale;
  return result;
}

}  // namespace lambent::math
