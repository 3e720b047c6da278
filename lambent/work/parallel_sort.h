// A sort on threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lambent/work/parallel_for.h"

namespace lambent::work {

/// Sorts by <. Blocks are sorted side by side, then merged in pairs; which blocks there are depends
/// on the number of values alone.
template <class Value>
void parallelSort(std::vector<Value>& values) {
  constexpr std::size_t kBlocks = 32, kWorthIt = 1u << 14;
  const std::size_t count = values.size();
  if (count < kWorthIt) return std::sort(values.begin(), values.end());
  const auto at = [&](std::size_t block) {
    return values.begin() + static_cast<std::ptrdiff_t>(count * std::min(block, kBlocks) / kBlocks);
  };
  parallelFor(kBlocks, [&](std::size_t b) { std::sort(at(b), at(b + 1)); });
  for (std::size_t width = 1; width < kBlocks; width *= 2)
    parallelFor(kBlocks / (2 * width), [&](std::size_t pair) {
      const std::size_t first = 2 * width * pair;
      std::inplace_merge(at(first), at(first + width), at(first + 2 * width));
    });
}

}  // namespace lambent::work
