#include "lambent/synthesis/synthesize.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/synthesis/meso_offsets.h"
#include "lambent/synthesis/similar_places.h"
#include "lambent/synthesis/synthesis_quality.h"
#include "lambent/synthesis/test_patches.h"
#include "lambent/work/thread_limit.h"

namespace lambent::synthesis {
namespace {

MesoMesh mesoOf(const scene::Mesh& mesh, std::uint32_t vertices) {
  const auto field = tangentField(mesh, {});
  EXPECT_TRUE(field);
  Result<MesoMesh> meso = mesoMesh(mesh, field->value, {.vertices = vertices}, {});
  EXPECT_TRUE(meso);
  return std::move(*meso);
}

std::vector<Vec2> synthesized(const MesoMesh& mesh, const Appearance& appearance,
                              const SynthesisOptions& options) {
  Result<std::vector<Vec2>> q = synthesize(mesh, appearance, options, {});
  EXPECT_TRUE(q) << q.error().message;
  EXPECT_EQ(q->size(), mesh.positions.size());
  for (const Vec2& place : *q) {
    EXPECT_TRUE(place.minCoeff() >= 0.0f && place.maxCoeff() < 1.0f);
  }
  return std::move(*q);
}

const Appearance& weave() {
  static const Appearance appearance = appearanceOf(patchOf(weaveAlbedo, 32), 4);
  return appearance;
}
const Appearance& stucco() {
  static const Appearance appearance = appearanceOf(patchOf(stuccoAlbedo, 32), 4);
  return appearance;
}

TEST(Synthesize, AFlatSheetIsTiledWithoutAJoint) {
  const MesoMesh mesh = mesoOf(scene::gridPlane(2.0f, 1.0f, 20, 10), 20000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.3f, 0.2f);
  options.randomness = 0.0f;
  const std::vector<Vec2> q = synthesized(mesh, weave(), options);
  const SynthesisQuality quality = qualityOf(mesh, weave(), options.patchSize, q);
  EXPECT_EQ(quality.coherent, 1.0);
  EXPECT_EQ(quality.joints, 0.0);
  EXPECT_LT(quality.mismatch, 1e-4);
  // Every place is that of one tiling of the plane, along the field and to its scale.
  const Vec3 x = mesh.tangents[0], y = mesh.normals[0].cross(x);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Vec3 d = mesh.positions[i] - mesh.positions[0];
    Vec2 off = q[i] - q[0] - Vec2(d.dot(x) / 0.3f, d.dot(y) / 0.2f);
    off -= Vec2(std::round(off.x()), std::round(off.y()));
    ASSERT_LT(off.norm(), 0.01f);
  }
}

TEST(Synthesize, AWeaveStaysAWeave) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 4), 40000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.5f, 0.5f);
  options.randomness = 0.0f;
  const SynthesisQuality still =
      qualityOf(mesh, weave(), options.patchSize, synthesized(mesh, weave(), options));
  EXPECT_GT(still.coherent, 0.93);
  EXPECT_LT(still.mismatch, 0.02);
  options.randomness = 0.5f;
  const SynthesisQuality scattered =
      qualityOf(mesh, weave(), options.patchSize, synthesized(mesh, weave(), options));
  EXPECT_GT(scattered.coherent, 0.88);
  EXPECT_LT(scattered.mismatch, 0.03);
  EXPECT_LT(scattered.mostUsed, 1.6);
  EXPECT_GT(scattered.leastUsed, 0.5);
}

TEST(Synthesize, StuccoHasNoJointsThatShowAndNoBlocks) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 4), 40000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.5f, 0.5f);
  options.randomness = 0.5f;
  const SynthesisQuality quality =
      qualityOf(mesh, stucco(), options.patchSize, synthesized(mesh, stucco(), options));
  EXPECT_GT(quality.coherent, 0.7);
  EXPECT_LT(quality.mismatch, 0.04);
  EXPECT_LT(quality.mostUsed, 2.0);
  EXPECT_GT(quality.leastUsed, 0.3);
  EXPECT_LT(quality.jointsAtBorder, 1.5);
}

TEST(Synthesize, CorrectionIsWorthItsTime) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 4), 20000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.6f, 0.6f);
  options.randomness = 1.0f;
  options.passes = 0;
  const SynthesisQuality before =
      qualityOf(mesh, stucco(), options.patchSize, synthesized(mesh, stucco(), options));
  options.passes = 2;
  const SynthesisQuality after =
      qualityOf(mesh, stucco(), options.patchSize, synthesized(mesh, stucco(), options));
  EXPECT_LT(after.mismatch, 0.6 * before.mismatch);
}

TEST(Synthesize, QualityTellsGoodFromBad) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 4), 20000);
  std::vector<Vec2> q(mesh.positions.size());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = math::Random(3, i).uniform2();
  const SynthesisQuality random = qualityOf(mesh, stucco(), Vec2(0.5f, 0.5f), q);
  EXPECT_LT(random.coherent, 0.02);
  EXPECT_NEAR(random.mismatch, 1.0, 0.1);  // bilinear look-ups take a little off
  EXPECT_GT(random.joints, 0.99);
  EXPECT_NEAR(random.mostUsed, 1.0, 0.3);
  EXPECT_NEAR(random.jointsAtBorder, 1.0, 0.05);
}

TEST(Synthesize, RandomnessBreaksTheRepetition) {
  const MesoMesh mesh = mesoOf(scene::gridPlane(4.0f, 4.0f, 4, 4), 30000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.5f, 0.5f);
  // How often the place one period further on is the same place.
  const auto repetition = [&](float randomness) {
    options.randomness = randomness;
    const std::vector<Vec2> q = synthesized(mesh, stucco(), options);
    const Vec3 x = mesh.tangents[0], y = mesh.normals[0].cross(x);
    double same = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Vec3 d = mesh.positions[i] - mesh.positions[0];
      Vec2 off = q[i] - q[0] - Vec2(d.dot(x), d.dot(y)) / 0.5f;
      off -= Vec2(std::round(off.x()), std::round(off.y()));
      same += off.norm() < 0.05f;
    }
    return same / double(q.size());
  };
  EXPECT_EQ(repetition(0.0f), 1.0);
  EXPECT_LT(repetition(0.5f), 0.2);
}

TEST(Synthesize, PebblesWithRoomBetweenThemStayWhole) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 4), 60000);
  const transfer::SimulatedRtt rtt = patchOf(pebblesAlbedo, 48);
  const PatchPieces pieces = piecesOf(lookOf(rtt));
  ASSERT_EQ(pieces.areas.size(), 12u);
  ASSERT_TRUE(pieces.leaveRoom());
  const Appearance appearance = appearanceOf(rtt, 4);
  SynthesisOptions options;
  options.patchSize = Vec2(0.5f, 0.5f);
  options.randomness = 0.5f;
  // Of the ways within pebbles, how many lead from a part of one to a part of another.
  const auto parted = [&](const PatchPieces* kept) {
    options.pieces = kept;
    const std::vector<Vec2> q = synthesized(mesh, appearance, options);
    const std::size_t finest = mesh.levels.size() - 1;
    const std::vector<Vec2> offsets = offsetsOf(mesh, finest, options.patchSize);
    std::size_t within = 0, parts = 0;
    for (std::uint32_t v = 0; v < q.size(); ++v) {
      std::size_t e = mesh.levels[finest].begin[v];
      for (const std::uint32_t j : mesh.neighbours(finest, v)) {
        const Vec2& offset = offsets[e++];
        if (pieces.at(q[v]) < 0 || pieces.at(q[v] + offset) != pieces.at(q[v])) continue;
        ++within;
        parts += wrapped(q[j] - q[v] - offset).norm() > 0.05f;
      }
    }
    return double(parts) / double(within);
  };
  const double round = parted(&pieces), through = parted(nullptr);
  EXPECT_LT(round, 0.01);
  EXPECT_LT(round, 0.3 * through);
  options.randomness = 0.0f;  // one layout, which tears where it does not meet
  EXPECT_LT(parted(&pieces), 0.01);
}

TEST(Synthesize, OpenSurfacesPartsAndTinyMeshesWork) {
  SynthesisOptions options;
  options.patchSize = Vec2(0.2f, 0.2f);
  const scene::Mesh parts[] = {scene::icosphere(0.3f, 3),
                               scene::translated(scene::gridPlane(1, 1, 2, 2), Vec3(2, 0, 0)),
                               scene::translated(scene::icosphere(0.002f, 1), Vec3(0, 3, 0)),
                               scene::translated(scene::bowl(0.3f, 0.4f, 20, 10), Vec3(-2, 0, 0))};
  const MesoMesh mesh = mesoOf(scene::merge(parts), 20000);
  const SynthesisQuality quality =
      qualityOf(mesh, weave(), options.patchSize, synthesized(mesh, weave(), options));
  EXPECT_GT(quality.coherent, 0.85);

  scene::Mesh one;
  one.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  one.triangles = {{0, 1, 2}};
  one.normals.assign(3, Vec3::UnitZ());
  synthesized(mesoOf(one, 3000), weave(), options);
}

TEST(Synthesize, APatchLargerThanTheSurfaceIsLaidOverItOnce) {
  const MesoMesh mesh = mesoOf(scene::gridPlane(1.0f, 1.0f, 4, 4), 3000);
  SynthesisOptions options;
  options.patchSize = Vec2(10.0f, 10.0f);
  options.randomness = 0.0f;
  const std::vector<Vec2> q = synthesized(mesh, weave(), options);
  EXPECT_EQ(qualityOf(mesh, weave(), options.patchSize, q).coherent, 1.0);
}

TEST(Synthesize, APatchTooSmallForTheMesoMeshNamesTheRemedy) {
  const scene::Mesh sphere = scene::icosphere(1.0f, 4);
  const MesoMesh mesh = mesoOf(sphere, 2000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.1f, 0.2f);
  const auto result = synthesize(mesh, weave(), options, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::BadUsage);
  // It takes 12.57 · 1.155 · (4 / 0.1)² = 23,200 of them; and with that many it works.
  EXPECT_NE(result.error().message.find("at least 2.37e+04 meso-vertices"), std::string::npos)
      << result.error().message;
  EXPECT_TRUE(synthesize(mesoOf(sphere, 24500), weave(), options, {}));
}

TEST(Synthesize, TheSameAtAnyNumberOfThreadsAndAnotherForEverySeed) {
  const MesoMesh mesh = mesoOf(scene::torus(1.0f, 0.4f, 40, 20), 20000);
  const transfer::SimulatedRtt pebbles = patchOf(pebblesAlbedo, 48);
  const PatchPieces pieces = piecesOf(lookOf(pebbles));
  SynthesisOptions options;
  options.patchSize = Vec2(0.6f, 0.6f);
  std::vector<Vec2> q[2], kept[2];
  for (int i = 0; i < 2; ++i) {
    const work::ThreadLimit threads(1 + 3 * i);
    options.pieces = nullptr;
    q[i] = synthesized(mesh, stucco(), options);
    options.pieces = &pieces;
    kept[i] = synthesized(mesh, appearanceOf(pebbles, 4), options);
  }
  EXPECT_EQ(std::memcmp(q[0].data(), q[1].data(), sizeof(Vec2) * q[0].size()), 0);
  EXPECT_EQ(std::memcmp(kept[0].data(), kept[1].data(), sizeof(Vec2) * kept[0].size()), 0);
  options.pieces = nullptr;
  options.seed = 1;
  EXPECT_NE(synthesized(mesh, stucco(), options), q[0]);
}

TEST(Synthesize, WrongUsageAndCancellingAreToldApart) {
  const MesoMesh mesh = mesoOf(scene::icosphere(1.0f, 2), 3000);
  SynthesisOptions options;
  options.patchSize = Vec2(0.0f, 1.0f);
  EXPECT_EQ(synthesize(mesh, weave(), options, {}).error().kind, ErrorKind::BadUsage);
  options.patchSize = Vec2(1.0f, 1.0f);
  options.randomness = 1.5f;
  EXPECT_EQ(synthesize(mesh, weave(), options, {}).error().kind, ErrorKind::BadUsage);
  options.randomness = 0.5f;
  EXPECT_EQ(
      synthesize(mesh, weave(), options, [](const ProgressUpdate&) { return false; }).error().kind,
      ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::synthesis
