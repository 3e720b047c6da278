// The random numbers of one path.
#pragma once

#include <cstdint>

#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/math/types.h"

namespace lambent::reference {

/// Pairs of numbers in [0, 1)², one sequence of scrambled Sobol points for each pair of a path's
/// dimensions, padded together. Paths 0, 1, 2, … of one batch are stratified against each other;
/// batches are independent, which is what makes the variance between them honest.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint64_t stream, std::uint64_t batch, std::uint32_t path)
      : key_(math::hashCombine(math::hashCombine(math::mix64(seed), stream), batch)), path_(path) {}

  Vec2 next() {
    return math::sobol2(path_, static_cast<std::uint32_t>(math::hashCombine(key_, pair_++) >> 32));
  }

 private:
  std::uint64_t key_;
  std::uint32_t path_;
  std::uint32_t pair_ = 0;
};

}  // namespace lambent::reference
