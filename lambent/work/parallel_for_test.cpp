#include "lambent/work/parallel_for.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "lambent/work/fork_join.h"
#include "lambent/work/parallel_sort.h"
#include "lambent/work/thread_limit.h"

namespace lambent::work {
namespace {

TEST(ParallelFor, TakesEveryItemOnce) {
  for (const int count : {0, 1, 7, 1000}) {
    std::vector<std::atomic<int>> times(static_cast<std::size_t>(count));
    parallelFor(count, [&](int i) { ++times[static_cast<std::size_t>(i)]; });
    for (const std::atomic<int>& n : times) EXPECT_EQ(n, 1);
  }
}

TEST(ParallelFor, RangesCoverAllAndAreNotCutBelowTheirGrain) {
  constexpr std::uint32_t kCount = 1000;
  constexpr std::size_t kGrain = 64;
  std::vector<std::atomic<int>> times(kCount);
  std::atomic<std::size_t> ranges{0};
  parallelRanges(kCount, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    ASSERT_LT(begin, end);
    ++ranges;
    for (std::uint32_t i = begin; i < end; ++i) ++times[i];
  });
  for (const std::atomic<int>& n : times) EXPECT_EQ(n, 1);
  // What has more than a grain may be halved; so none has less than half of one.
  EXPECT_LE(ranges, 2 * kCount / kGrain + 1);
}

TEST(ParallelFor, WhatAPartThrowsReachesTheCaller) {
  EXPECT_THROW(parallelFor(100,
                           [](int i) {
                             if (i == 50) throw std::runtime_error("here");
                           }),
               std::runtime_error);
}

TEST(ParallelFor, LoopsWithinLoops) {
  std::atomic<int> sum{0};
  parallelFor(10, [&](int) { parallelFor(10, [&](int k) { sum += k; }); });
  EXPECT_EQ(sum, 10 * 45);
}

TEST(ParallelSort, IsWhatASortGives) {
  std::uint64_t state = 1;
  for (const std::size_t count : {0u, 1u, 1000u, 16383u, 16384u, 16385u, 100003u}) {
    std::vector<std::uint64_t> values(count);
    for (std::uint64_t& v : values) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      v = state >> 50;  // with many that are equal
    }
    std::vector<std::uint64_t> expected = values;
    std::sort(expected.begin(), expected.end());
    parallelSort(values);
    EXPECT_EQ(values, expected) << count;
  }
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const ThreadLimit limit(1);
  std::mutex guard;
  std::set<std::thread::id> threads;
  parallelFor(1000, [&](int) {
    const std::lock_guard lock(guard);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

#ifdef LAMBENT_THREAD_SANITIZER
// That the other tests pass under the thread sanitizer says something: it does see our loops.
TEST(ThreadSanitizer, SeesARaceBetweenThePartsOfALoop) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto race = [] {
    long sum = 0;
    parallelFor(1 << 16, [&](int i) { sum += i; });
    _exit(0);  // the sanitizer makes 66 of it where it has reported
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif

}  // namespace
}  // namespace lambent::work
