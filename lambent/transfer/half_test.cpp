#include "lambent/transfer/half.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace lambent::transfer {
namespace {

bool isNan(std::uint16_t half) {
  return (half & 0x7fffu) > 0x7c00u;
}

/// What a half means, straight from the definition of the format.
double valueOf(std::uint16_t half) {
  const double sign = half & 0x8000u ? -1.0 : 1.0;
  const int exponent = (half >> 10) & 31, significand = half & 1023;
  if (exponent == 0) return sign * std::ldexp(significand, -24);
  return sign * std::ldexp(1024 + significand, exponent - 25);
}

/// The nearest finite half by bisection over all of them, ties to the even one: slow and plain.
std::uint16_t oracle(float value) {
  const double magnitude = std::abs(double(value));
  std::uint16_t lower = 0, upper = 0x7bff;  // finite positive halves are sorted as integers
  while (upper - lower > 1) {
    const std::uint16_t middle = std::uint16_t((lower + upper) / 2);
    (valueOf(middle) <= magnitude ? lower : upper) = middle;
  }
  const double below = magnitude - valueOf(lower), above = valueOf(upper) - magnitude;
  const bool up = above < below || (above == below && (lower & 1));
  return std::uint16_t((std::signbit(value) ? 0x8000 : 0) | (up ? upper : lower));
}

std::vector<float> testValues() {
  std::vector<float> values;
  // Every half, the midpoint to the next one, and both neighbours of each.
  for (std::uint32_t h = 0; h < 0x7c00u; ++h) {
    const double here = valueOf(std::uint16_t(h));
    const double next = h == 0x7bffu ? 65536.0 : valueOf(std::uint16_t(h + 1));
    for (double v : {here, 0.5 * (here + next)})
      for (float f : {float(v), std::nextafter(float(v), -1.0f), std::nextafter(float(v), 1e9f)})
        values.insert(values.end(), {f, -f});
  }
  std::mt19937 random(7);
  for (int i = 0; i < 200000; ++i) {
    const float f = std::bit_cast<float>(std::uint32_t(random()));
    if (std::isfinite(f)) values.push_back(f);
  }
  for (float f : {std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::min(),
                  std::numeric_limits<float>::max(), 65519.99f, 65520.0f, 65536.0f})
    values.insert(values.end(), {f, -f});
  return values;
}

TEST(Half, DecodesEveryHalfExactly) {
  for (std::uint32_t h = 0; h < 65536; ++h) {
    const float value = floatFromHalf(std::uint16_t(h));
    if (isNan(std::uint16_t(h))) {
      EXPECT_TRUE(std::isnan(value));
    } else if ((h & 0x7fffu) == 0x7c00u) {
      EXPECT_TRUE(std::isinf(value));
      EXPECT_EQ(std::signbit(value), h == 0xfc00u);
    } else {
      ASSERT_EQ(double(value), valueOf(std::uint16_t(h))) << h;
      ASSERT_EQ(std::signbit(value), (h & 0x8000u) != 0) << h;
    }
  }
}

TEST(Half, EveryHalfSurvivesTheRoundTrip) {
  for (std::uint32_t h = 0; h < 65536; ++h) {
    const std::uint32_t quiet = isNan(std::uint16_t(h)) ? 0x200u : 0u;
    ASSERT_EQ(halfFromFloat(floatFromHalf(std::uint16_t(h))), h | quiet);
  }
}

TEST(Half, RoundsToNearestEven) {
  for (float value : testValues()) ASSERT_EQ(halfFromFloat(value), oracle(value)) << value;
}

TEST(Half, ClampsWhatIsFiniteAndKeepsWhatIsNot) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(halfFromFloat(1e30f), 0x7bff);
  EXPECT_EQ(halfFromFloat(-65520.0f), 0xfbff);
  EXPECT_EQ(halfFromFloat(infinity), 0x7c00);
  EXPECT_EQ(halfFromFloat(-infinity), 0xfc00);
  EXPECT_TRUE(isNan(halfFromFloat(std::numeric_limits<float>::quiet_NaN())));
  // A NaN whose payload lies in the dropped bits must not become an infinity.
  EXPECT_TRUE(isNan(halfFromFloat(std::bit_cast<float>(0x7f800001u))));
}

TEST(Half, BlocksGiveTheSameBitsAsTheDefinition) {
  std::vector<float> values = testValues();
  for (std::uint32_t bits : {0x7f800000u, 0xff800000u, 0x7fc00000u, 0xffc12345u, 0x7f800001u})
    values.push_back(std::bit_cast<float>(bits));
  std::vector<std::uint16_t> halves(values.size());
  halvesFromFloats(values, halves);
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(halves[i], halfFromFloat(values[i])) << values[i];

  std::vector<std::uint16_t> all(65536);
  for (std::uint32_t h = 0; h < 65536; ++h) all[h] = std::uint16_t(h);
  std::vector<float> decoded(all.size());
  floatsFromHalves(all, decoded);
  for (std::uint32_t h = 0; h < 65536; ++h)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(decoded[h]),
              std::bit_cast<std::uint32_t>(floatFromHalf(std::uint16_t(h))));
}

TEST(Half, BlocksOfAnyLengthTouchOnlyTheirOwn) {
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<float> values(count, 1.5f), back(count + 1, -7.0f);
    std::vector<std::uint16_t> halves(count + 1, 0xabcd);
    halvesFromFloats(values, std::span(halves).first(count));
    floatsFromHalves(std::span(halves).first(count), std::span(back).first(count));
    EXPECT_EQ(halves[count], 0xabcd);
    EXPECT_EQ(back[count], -7.0f);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(back[i], 1.5f);
  }
}

}  // namespace
}  // namespace lambent::transfer
