// A pass over a range of chunks is a function of the range and of the pass before: run over the
// parts of a range, in any sequence, with any memory and threads, it gives what it gives for the
// whole.
#include "lambent/macro/passes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "lambent/macro/collect.h"
#include "lambent/macro/test_bake.h"

namespace lambent::macro {
namespace {

/// All that passes look at, of every kind of surface, texels and tangent frames.
struct Bed {
  scene::Scene scene = mixedScene();
  trace::RayScene rays;
  PlacedReceivers receivers;
  DirectionSets directions;
  Simulation simulation;

  explicit Bed(const BakeOptions& options)
      : rays(std::move(*trace::RayScene::build(scene))),
        receivers(std::move(*transport::placeReceivers(scene, {{{0, 20, 12}}, {framesOfBox(scene)}},
                                                       rays.offset()))),
        directions(options.directions, options.seed, scene::bounds(scene)),
        simulation(scene, rays, receivers, directions, options,
                   channelsFor(scene, receivers, options.kind)) {}

  static LocalFrames framesOfBox(const scene::Scene& scene) {
    LocalFrames frames{1, {}};
    for (const Vec3& n : scene.meshes[1].normals) frames.tangents.push_back(n.unitOrthogonal());
    return frames;
  }
};

/// Rows of all receivers, full of what no pass writes.
struct Storage {
  std::vector<float> incident, exit, matrices;

  explicit Storage(const Simulation& s)
      : incident(s.receivers.size() * s.rowStride, kOld),
        exit(incident.size(), kOld),
        matrices(s.matrixCount * s.matrixStride(), kOld) {}
  RowsToWrite rows() { return {incident, exit, matrices}; }
  bool operator==(const Storage&) const = default;

  static constexpr float kOld = -12345.0f;
};

/// 0 … n in three parts, the last first.
std::vector<work::ChunkRange> partsOf(work::ChunkRange all) {
  EXPECT_GT(all.end, 5u);
  return {{all.end - 2, all.end}, {0, 1}, {1, all.end - 2}};
}

void expectSame(const DirectChunk& a, const DirectChunk& b) {
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.counts, b.counts);
}

TEST(Passes, PutTogetherArePassesOverTheWhole) {
  const Bed bed(small());
  const Simulation& s = bed.simulation;
  ASSERT_TRUE(s.isBouncing());
  ASSERT_GT(s.matrixCount, 0u);
  const work::ChunkRange all = s.chunks().range();
  const std::vector<work::ChunkRange> parts = partsOf(all);
  const work::Runner one({}, 1), three({}, 3);

  Storage whole(s), together(s);
  const auto direct = directPass(s, all, three, whole.rows());
  ASSERT_TRUE(direct);
  ASSERT_EQ(direct->chunks.size(), all.size());
  std::vector<DirectPass> directs;
  for (const work::ChunkRange part : parts) {
    auto pass = directPass(s, part, one, together.rows());
    ASSERT_TRUE(pass);
    ASSERT_EQ(pass->chunks.size(), part.size());
    for (std::size_t k = 0; k < part.size(); ++k)
      expectSame(pass->chunks[k], direct->chunks[part.begin + k]);
    directs.push_back(std::move(*pass));
  }
  EXPECT_EQ(whole, together);

  const KeptHits nothing({}, 0);
  PassRows previous{whole.exit, whole.matrices};
  for (const int number : {1, 2}) {
    Storage wholeBounce(s), togetherBounce(s);
    const auto energies =
        bouncePass(s, all, {number, previous, direct->kept}, three, wholeBounce.rows());
    ASSERT_TRUE(energies);
    double sum = 0.0;
    for (const double energy : *energies) sum += energy;
    EXPECT_GT(sum, 0.0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      // One part has nothing kept, and casts again.
      const KeptHits& kept = p == 1 ? nothing : directs[p].kept;
      const auto pass =
          bouncePass(s, parts[p], {number, previous, kept}, one, togetherBounce.rows());
      ASSERT_TRUE(pass);
      for (std::size_t k = 0; k < parts[p].size(); ++k)
        EXPECT_EQ((*pass)[k], (*energies)[parts[p].begin + k]);
    }
    EXPECT_EQ(wholeBounce, togetherBounce);
    previous = {wholeBounce.exit, wholeBounce.matrices};
  }
}

TEST(Passes, WriteTheRowsOfTheirOwnReceiversAlone) {
  const Bed bed(small());
  const Simulation& s = bed.simulation;
  const work::ChunkRange range{2, 3};
  Storage storage(s);
  const work::Runner runner;
  ASSERT_TRUE(directPass(s, range, runner, storage.rows()));
  std::vector<bool> own(s.receivers.size());
  const work::Chunk chunk = s.chunks()[2];
  for (std::size_t k = chunk.begin; k < chunk.end; ++k) own[s.order[k]] = true;
  for (std::uint32_t r = 0; r < s.receivers.size(); ++r) {
    for (std::size_t j = 0; j < std::size_t(s.channels) * s.inCount; ++j) {
      EXPECT_EQ(storage.incident[r * s.rowStride + j] != Storage::kOld, own[r]);
      EXPECT_EQ(storage.exit[r * s.rowStride + j] != Storage::kOld, own[r]);
    }
    if (!s.hasMatrix(r)) continue;
    EXPECT_EQ(storage.matrices[s.matrixIndex[r] * s.matrixStride()] != Storage::kOld, own[r]);
  }
}

TEST(Passes, ThatAreAloneNeedNoExits) {
  for (const transfer::Kind kind : {transfer::Kind::Unshadowed, transfer::Kind::Shadowed}) {
    BakeOptions options = small();
    options.kind = kind;
    const Bed bed(options);
    const Simulation& s = bed.simulation;
    ASSERT_FALSE(s.isBouncing());
    Storage with(s), without(s);
    const work::Runner runner;
    const auto a = directPass(s, s.chunks().range(), runner, with.rows());
    const auto b =
        directPass(s, s.chunks().range(), runner, {without.incident, {}, without.matrices});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(with.incident, without.incident);
    EXPECT_EQ(with.matrices, without.matrices);
    EXPECT_EQ(a->kept.bytes(), 0u);
    for (std::size_t k = 0; k < a->chunks.size(); ++k) expectSame(a->chunks[k], b->chunks[k]);
  }
}

TEST(Passes, SayThatTheyWereCancelled) {
  const Bed bed(small());
  const Simulation& s = bed.simulation;
  Storage storage(s);
  const work::Runner runner([](const ProgressUpdate&) { return false; });
  const auto direct = directPass(s, s.chunks().range(), runner, storage.rows());
  ASSERT_FALSE(direct);
  EXPECT_EQ(direct.error().kind, ErrorKind::Cancelled);
  const PassRows previous{storage.exit, storage.matrices};
  const KeptHits nothing({}, 0);
  const auto bounce =
      bouncePass(s, s.chunks().range(), {1, previous, nothing}, runner, storage.rows());
  ASSERT_FALSE(bounce);
  EXPECT_EQ(bounce.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::macro
