#include "lambent/transport/kept_hits.h"

#include <gtest/gtest.h>

#include <numeric>

#include "lambent/transport/packed_hits.h"
#include "lambent/work/runner.h"

namespace lambent::transport {
namespace {

struct Numbers {
  std::vector<std::uint32_t> values;

  std::size_t bytes() const { return 4 * values.size(); }
  void shrink() { values.shrink_to_fit(); }
};

Numbers numbersOf(std::size_t chunk) {
  Numbers numbers{std::vector<std::uint32_t>(10 + chunk % 7)};
  std::iota(numbers.values.begin(), numbers.values.end(), static_cast<std::uint32_t>(chunk));
  return numbers;
}

TEST(KeptHits, KeepsAllThatThereIsRoomFor) {
  KeptHits<Numbers> kept({3, 9}, 1000);
  for (std::size_t chunk = 3; chunk < 9; ++chunk) kept.keep(chunk, numbersOf(chunk));
  for (std::size_t chunk = 3; chunk < 9; ++chunk) {
    ASSERT_NE(kept.of(chunk), nullptr);
    EXPECT_EQ(kept.of(chunk)->values, numbersOf(chunk).values);
  }
  EXPECT_EQ(kept.of(2), nullptr);
  EXPECT_EQ(kept.of(9), nullptr);
}

TEST(KeptHits, StaysWithinItsBudgetFromAnyThread) {
  for (const int threads : {1, 4}) {
    KeptHits<Numbers> kept({0, 500}, 5000);
    const work::Runner runner({}, threads);
    ASSERT_TRUE(runner.run({"keeping", "chunks"}, work::Chunks(500), [&](const work::Chunk& chunk) {
      kept.keep(chunk.index, numbersOf(chunk.index));
    }));
    std::size_t bytes = 0, count = 0;
    for (std::size_t chunk = 0; chunk < 500; ++chunk) {
      if (!kept.of(chunk)) continue;
      EXPECT_EQ(kept.of(chunk)->values, numbersOf(chunk).values);
      bytes += kept.of(chunk)->bytes(), ++count;
    }
    EXPECT_EQ(bytes, kept.bytes());
    EXPECT_LE(bytes, 5000u);
    EXPECT_GT(count, 50u);
    EXPECT_LT(count, 500u);
  }
}

TEST(KeptHits, ChunksWithoutHitsNeedNoRoom) {
  KeptHits<Numbers> kept({0, 2}, 0);
  kept.keep(0, {});
  kept.keep(1, numbersOf(1));
  EXPECT_NE(kept.of(0), nullptr);
  EXPECT_EQ(kept.of(1), nullptr);
}

TEST(PackedHits, GiveBackWhatTheyTook) {
  constexpr std::size_t kDirections = 1000;
  PackedHits packed;
  std::vector<ReceiverHits> given;
  for (const std::uint32_t step : {1u, 3u, 40u, 900u}) {  // as bits, as bits, as lists
    ReceiverHits& hits = given.emplace_back();
    for (std::uint32_t d = step - 1; d < kDirections; d += step) {
      hits.receiver.push_back(d * 7 + step);
      hits.direction.push_back(static_cast<std::uint16_t>(d));
    }
    if (step == 3) hits.mirrored.push_back({5, 6, Vec3(0, 1, 0), Rgb(0.5f, 0.25f, 1.0f)});
    if (step == 40) hits.colour = {7, 8, 9};
    packed.add(hits, kDirections);
  }
  ReceiverHits got;
  for (std::size_t k = 0; k < given.size(); ++k) {
    packed.get(k, kDirections, got);
    EXPECT_EQ(got.receiver, given[k].receiver);
    EXPECT_EQ(got.direction, given[k].direction);
    EXPECT_EQ(got.colour, given[k].colour);
    ASSERT_EQ(got.mirrored.size(), given[k].mirrored.size());
    for (const MirroredHit& hit : got.mirrored) EXPECT_EQ(hit.direction, 6u);
  }
}

}  // namespace
}  // namespace lambent::transport
