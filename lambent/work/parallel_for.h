// A loop on threads for what takes a moment: nobody listens to it and nothing stops it. What takes
// longer is a Runner's.
#pragma once

#include <cstddef>
#include <functional>

namespace lambent::work {

/// body(begin, end) for ranges that cover 0 … count − 1, each item once. No range is cut that has
/// `grain` items or fewer.
void runRanges(std::size_t count, std::size_t grain,
               const std::function<void(std::size_t begin, std::size_t end)>& body);

/// The same with the type of number that the caller counts in.
template <class Index, class Body>
void parallelRanges(Index count, std::size_t grain, const Body& body) {
  runRanges(static_cast<std::size_t>(count), grain, [&body](std::size_t begin, std::size_t end) {
    body(static_cast<Index>(begin), static_cast<Index>(end));
  });
}

/// body(i) for i in 0 … count − 1, each once, in any sequence.
template <class Index, class Body>
void parallelFor(Index count, const Body& body) {
  parallelRanges(count, 1, [&body](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) body(i);
  });
}

}  // namespace lambent::work
