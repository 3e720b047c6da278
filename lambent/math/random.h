// Random numbers that depend on their key alone: the n-th number of (seed, stream, substream) is
// the same whatever thread asks for it and whatever was asked for before. A stream is, say, a
// receiver or a pixel; a substream a sample of it.
//
// This work is based on:
// - steele2014fast (SplitMix64): §3, the finalizer mix64 and the golden-ratio step of the counter.
#pragma once

#include <cstdint>

#include "lambent/math/types.h"

namespace lambent::math {

/// A bijection of the 64-bit integers in which every output bit depends on every input bit.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// One number out of two, not symmetric in them.
constexpr std::uint64_t hashCombine(std::uint64_t a, std::uint64_t b) {
  return mix64(mix64(a + 0x9e3779b97f4a7c15u) ^ (b * 0xd1342543de82ef95u + 0x632be59bd9b4e019u));
}

/// The top 24 bits as a float in [0, 1): exact, and never rounded up to 1.
constexpr float unitFloat(std::uint64_t bits) {
  return static_cast<float>(bits >> 40) * 0x1p-24f;
}

/// The sequence of numbers that belongs to one key. Cheap to make: make one per sample.
class Random {
 public:
  constexpr Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t substream = 0)
      : state_(hashCombine(hashCombine(mix64(seed), stream), substream)) {}

  constexpr std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15u;
    return mix64(state_);
  }
  /// In [0, 1).
  constexpr float uniform() { return unitFloat(bits()); }
  /// In [0, 1)².
  Vec2 uniform2() {
    const std::uint64_t b = bits();
    return Vec2(unitFloat(b), unitFloat(b << 32));
  }
  /// In [0, 1), with 53 bits.
  constexpr double uniformDouble() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In 0 … count − 1, count > 0 (bias below count / 2³²).
  constexpr std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((bits() >> 32) * count) >> 32);
  }

 private:
  std::uint64_t state_;
};

/// A rotation drawn uniformly from SO(3) (the Haar measure); the same for the same seed.
Mat3 randomRotation(std::uint64_t seed);
Mat3d randomRotationDouble(std::uint64_t seed);

}  // namespace lambent::math
