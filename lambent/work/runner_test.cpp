#include "lambent/work/runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <string>
#include <thread>

#include "lambent/work/flush_denormals.h"
#include "lambent/work/parallel_for.h"

namespace lambent::work {
namespace {

struct Nothing {};

TEST(Chunks, CoverEveryItemOnce) {
  for (const std::size_t items : {0, 1, 63, 64, 65, 640})
    for (const std::size_t size : {1, 7, 64}) {
      const Chunks chunks(items, size);
      std::size_t next = 0;
      for (std::size_t k = 0; k < chunks.range().end; ++k) {
        EXPECT_EQ(chunks[k].index, k);
        EXPECT_EQ(chunks[k].begin, next);
        EXPECT_GT(chunks[k].size(), 0u);
        EXPECT_LE(chunks[k].size(), size);
        next = chunks[k].end;
      }
      EXPECT_EQ(next, items);
      EXPECT_EQ(chunks.items(), items);
    }
}

TEST(Chunks, OfARangeAreThoseOfTheWhole) {
  const Chunks whole(100, 8);
  const Chunks part = whole.within({3, 13});
  EXPECT_EQ(part.items(), 76u);
  EXPECT_EQ(part[12].begin, whole[12].begin);
  EXPECT_EQ(part[12].end, 100u);
  EXPECT_EQ(whole.within({2, 2}).items(), 0u);
}

TEST(Runner, WorksOnEveryChunkOnce) {
  for (const int threads : {0, 1, 3}) {
    std::vector<std::atomic<int>> times(1000);
    const Runner runner({}, threads);
    ASSERT_TRUE(
        runner.run({"counting", "items"}, Chunks(times.size(), 16), [&](const Chunk& chunk) {
          for (std::size_t k = chunk.begin; k < chunk.end; ++k) ++times[k];
        }));
    for (const auto& count : times) EXPECT_EQ(count, 1);
  }
}

// Floating-point sums depend on their sequence: the same bits mean the same sequence.
TEST(Runner, ResultsComeInSequenceAtAnyThreadCount) {
  const auto sumWith = [](int threads) {
    const Runner runner({}, threads);
    const auto sums = runner.map({"summing", "items"}, Chunks(10000, 7), Nothing{},
                                 [](const Chunk& chunk, Nothing&) {
                                   double sum = 0.0;
                                   for (std::size_t k = chunk.begin; k < chunk.end; ++k)
                                     sum += std::sin(1e3 * static_cast<double>(k));
                                   return sum;
                                 });
    EXPECT_TRUE(sums);
    return std::accumulate(sums->begin(), sums->end(), 0.0);
  };
  const double one = sumWith(1);
  for (const int threads : {0, 2, 5}) EXPECT_EQ(sumWith(threads), one);
}

TEST(Runner, MapsARangeOfChunks) {
  const Runner runner;
  const auto indices = runner.map({"naming", "items"}, Chunks(100, 8).within({3, 6}), Nothing{},
                                  [](const Chunk& chunk, Nothing&) { return chunk.index; });
  ASSERT_TRUE(indices);
  EXPECT_EQ(*indices, (std::vector<std::size_t>{3, 4, 5}));
}

TEST(Runner, ScratchesBelongToOneThreadAtATime) {
  std::atomic<int> clashes{0}, unlike{0};
  std::mutex guard;
  std::set<const void*> seen, used;
  const Runner runner({}, 4);
  const std::vector<int> prototype(5, 7);
  ASSERT_TRUE(runner.run({"working", "chunks"}, Chunks(2000), prototype,
                         [&](const Chunk&, std::vector<int>& scratch) {
                           {
                             const std::lock_guard lock(guard);
                             if (!used.insert(&scratch).second) ++clashes;
                             if (seen.insert(&scratch).second && scratch != prototype) ++unlike;
                           }
                           ++scratch[0];
                           const std::lock_guard lock(guard);
                           used.erase(&scratch);
                         }));
  EXPECT_EQ(clashes, 0);
  EXPECT_EQ(unlike, 0);
  EXPECT_LE(seen.size(), 4u);
}

TEST(Runner, TellsItsProgressFromBeginningToEnd) {
  std::vector<std::uint64_t> done;
  const auto listen = [&](const ProgressUpdate& update) {
    EXPECT_EQ(update.stage, "waiting");
    EXPECT_EQ(update.unit, "rays");
    EXPECT_EQ(update.total, 3u * 250u);
    done.push_back(update.done);
    return true;
  };
  const Runner runner(listen, 2);
  ASSERT_TRUE(runner.run({"waiting", "rays", 3}, Chunks(250, 4), [](const Chunk&) {}));
  ASSERT_GE(done.size(), 2u);
  EXPECT_EQ(done.front(), 0u);
  EXPECT_EQ(done.back(), 750u);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(Runner, TellsAFewTimesASecondAndNeverFromTwoThreadsAtOnce) {
  using namespace std::chrono_literals;
  std::atomic<int> inside{0}, clashes{0}, calls{0};
  const auto listen = [&](const ProgressUpdate&) {
    if (++inside > 1) ++clashes;
    std::this_thread::sleep_for(2ms);
    --inside;
    ++calls;
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  const Runner runner(listen, 4);
  ASSERT_TRUE(runner.run({"waiting", "chunks"}, Chunks(400),
                         [](const Chunk&) { std::this_thread::sleep_for(2ms); }));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(clashes, 0);
  EXPECT_GE(calls, 3);
  EXPECT_LE(calls, 3.0 + 10.0 * seconds);
}

TEST(Runner, StopsWhenAskedAndSaysSo) {
  using namespace std::chrono_literals;
  for (const int threads : {1, 3}) {
    std::atomic<int> worked{0};
    int calls = 0;
    const Runner runner([&](const ProgressUpdate&) { return ++calls < 2; }, threads);
    const Status status = runner.run({"waiting", "chunks"}, Chunks(5000), [&](const Chunk&) {
      ++worked;
      std::this_thread::sleep_for(1ms);
    });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::Cancelled);
    EXPECT_GT(worked, 0);
    EXPECT_LT(worked, 5000);
    EXPECT_EQ(calls, 2);  // who has asked to stop hears no more
  }
  bool worked = false;
  const Runner never([](const ProgressUpdate&) { return false; });
  EXPECT_FALSE(never.run({"nothing", "chunks"}, Chunks(8), [&](const Chunk&) { worked = true; }));
  EXPECT_FALSE(worked);
}

TEST(Runner, StoppedMapsYieldNoValues) {
  const Runner runner([](const ProgressUpdate&) { return false; });
  const auto values = runner.map({"nothing", "chunks"}, Chunks(8), Nothing{},
                                 [](const Chunk& chunk, Nothing&) { return chunk.index; });
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, ErrorKind::Cancelled);
}

#if defined(__SSE2__)
float half(float value) {
  const volatile float v = value;
  return v * 0.5f;
}

TEST(Runner, FlushesDenormalsInsideAndRestoresThem) {
  const float smallest = std::numeric_limits<float>::min();
  std::atomic<int> kept{0};
  const Runner runner({}, 3);
  ASSERT_TRUE(runner.run({"halving", "chunks"}, Chunks(300), [&](const Chunk&) {
    if (half(smallest) != 0.0f) ++kept;
  }));
  EXPECT_EQ(kept, 0);
  EXPECT_NE(half(smallest), 0.0f);
  // The threads that worked are as they were, too.
  std::atomic<int> flushed{0};
  work::parallelFor(300, [&](int) {
    if (half(smallest) == 0.0f) ++flushed;
  });
  EXPECT_EQ(flushed, 0);
}

TEST(FlushDenormals, Nests) {
  const float smallest = std::numeric_limits<float>::min();
  {
    const FlushDenormals outer;
    { const FlushDenormals inner; }
    EXPECT_EQ(half(smallest), 0.0f);
  }
  EXPECT_NE(half(smallest), 0.0f);
}
#endif

}  // namespace
}  // namespace lambent::work
