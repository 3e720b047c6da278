// Properties of a bake: the same whatever the threads or the memory, linear, coloured, diagnosed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lambent/macro/test_bake.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/coefficients.h"

namespace lambent::macro {
namespace {

void expectSameNumbers(const TransferField& a, const TransferField& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  EXPECT_EQ(a.passEnergy, b.passEnergy);
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].vectors, b.meshes[m].vectors);
    EXPECT_EQ(a.meshes[m].matrices, b.meshes[m].matrices);
  }
}

TEST(Bake, IsTheSameAtAnyThreadCount) {
  BakeOptions options = small();
  options.threads = 1;
  const TransferField one = bakeOrDie(mixedScene(), options);
  options.threads = 4;
  const TransferField four = bakeOrDie(mixedScene(), options);
  expectSameNumbers(one, four);
}

TEST(Bake, IsTheSameWhenHitsDoNotFitAndAreCastAgain) {
  BakeOptions options = small();
  const TransferField kept = bakeOrDie(mixedScene(), options);
  options.hitMemory = 0;
  const TransferField again = bakeOrDie(mixedScene(), options);
  expectSameNumbers(kept, again);
}

TEST(Bake, SeedsGiveIndependentErrorsOfTheSameSize) {
  BakeOptions options = small();
  options.kind = TransferKind::Shadowed;
  const TransferField a = bakeOrDie(mixedScene(), options);
  options.seed = 1;
  const TransferField b = bakeOrDie(mixedScene(), options);
  EXPECT_NE(a.meshes[0].vectors, b.meshes[0].vectors);
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < a.meshes[0].vectors.size(); ++k) {
    difference += std::pow(a.meshes[0].vectors[k] - b.meshes[0].vectors[k], 2);
    size += std::pow(a.meshes[0].vectors[k], 2);
  }
  EXPECT_LT(std::sqrt(difference / size), 0.05);
}

TEST(Bake, LeavesEmissionOutAndSaysSo) {
  scene::Scene glowing = mixedScene();
  glowing.materials[std::size_t(glowing.meshes[0].material)].emission = Rgb(5, 5, 5);
  const auto dark = bakeScene(mixedScene(), small());
  const auto bright = bakeScene(glowing, small());
  ASSERT_TRUE(dark && bright);
  expectSameNumbers(dark->value, bright->value);
  const Findings &without = dark->findings, &with = bright->findings;
  ASSERT_EQ(with.size(), without.size() + 1);
  EXPECT_EQ(with.back().code, "emission-left-out");
}

TEST(Bake, ARedWallBleedsRed) {
  const TransferField field = bakeOrDie(mixedScene(), small());
  const MeshTransfer& floor = field.meshes[0];
  ASSERT_EQ(floor.channels, 3);
  // Beside the wall the floor is redder than far from it.
  const auto redness = [&](float x) {
    double red = 0.0, blue = 0.0;
    for (std::size_t r = 0; r < floor.receiverCount(); ++r)
      if (std::abs(floor.positions[r].x() - x) < 0.2f && std::abs(floor.positions[r].z()) < 1.0f) {
        red += floor.vectors[(r * 3 + 0) * 9];
        blue += floor.vectors[(r * 3 + 2) * 9];
      }
    return red / blue;
  };
  EXPECT_GT(redness(-1.33f), 1.05 * redness(1.9f));
}

TEST(Bake, EveryKindOfReceiverIsServed) {
  const TransferField field = bakeOrDie(mixedScene(), small());
  EXPECT_FALSE(field.meshes[0].vectors.empty());
  EXPECT_TRUE(field.meshes[0].matrices.empty());
  EXPECT_FALSE(field.meshes[2].vectors.empty());
  EXPECT_EQ(field.meshes[2].matrices.size(), field.meshes[2].receiverCount() * 3 * 9 * 9);
  EXPECT_EQ(field.meshes[3].layout, Layout::None);
  ASSERT_EQ(field.passEnergy.size(), 3u);
  EXPECT_LT(field.passEnergy[2], field.passEnergy[1]);
  EXPECT_LT(field.passEnergy[1], field.passEnergy[0]);
}

// The direct light is the same numbers whether bounces follow or not: kept, it is a shadowed bake.
TEST(Bake, KeptShadowedTransferIsAShadowedBake) {
  scene::Scene painted = mixedScene(), grey = painted;
  for (scene::Material& material : grey.materials)
    if (material.isMirror()) material.mirror = Rgb::Constant(0.8f);
  for (const bool isPainted : {true, false})
    for (const std::size_t memory : {std::size_t(1) << 30, std::size_t(0)})
      for (const int bounces : {0, 2}) {
        const scene::Scene& scene = isPainted ? painted : grey;
        BakeOptions options = small();
        options.glossyBands = 2;
        const Placement placement{{{0, 20, 12}}, {}};
        options.hitMemory = memory;
        options.kind = TransferKind::Shadowed;
        const TransferField alone = bakeOrDie(scene, options, placement);
        options.kind = TransferKind::Interreflected;
        options.bounces = bounces;
        const TransferField plain = bakeOrDie(scene, options, placement);
        options.keepShadowed = true;
        const TransferField both = bakeOrDie(scene, options, placement);
        expectSameNumbers(both, plain);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
          const MeshTransfer& a = alone.meshes[m];
          const ShadowedTransfer& kept = both.meshes[m].shadowed;
          EXPECT_EQ(kept.channels, a.channels);
          EXPECT_EQ(kept.vectors, a.vectors);
          EXPECT_EQ(kept.matrixChannels, a.matrixChannels);
          EXPECT_EQ(kept.matrices, a.matrices);
          EXPECT_TRUE(a.shadowed.empty() && plain.meshes[m].shadowed.empty());
        }
        EXPECT_FALSE(both.meshes[0].shadowed.vectors.empty());
        EXPECT_FALSE(both.meshes[2].shadowed.matrices.empty());
        // Only what has a colour of its own, or is lit by a painted mirror, needs three channels.
        EXPECT_EQ(both.meshes[2].shadowed.matrixChannels, isPainted ? 3 : 1);
        EXPECT_EQ(both.meshes[2].matrixChannels, 3);
      }
}

TEST(Bake, StopsWhenAPassHasLittleEnergy) {
  BakeOptions options = small();
  options.bounces = 50;
  options.energyThreshold = 1e-4;
  const TransferField field = bakeOrDie(mixedScene(), options);
  EXPECT_LT(field.bounces, 20);
  EXPECT_LE(field.passEnergy.back(), 1e-4 * field.passEnergy.front());
}

TEST(Bake, ColourCostsChannelsOnlyWhereItIsNeeded) {
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(1, 1), painted(Rgb(0.9f, 0.5f, 0.1f)));
  BakeOptions options = small();
  options.kind = TransferKind::Shadowed;
  EXPECT_EQ(bakeOrDie(scene, options).meshes[0].channels, 3);
  scene.materials[0].diffuse = Rgb::Constant(0.5f);
  EXPECT_EQ(bakeOrDie(scene, options).meshes[0].channels, 1);
}

TEST(Bake, TexelsOfAPlaneAgreeWithVerticesAtTheirCentres) {
  constexpr int kSide = 8;
  const auto underBall = [](scene::Mesh plane) {
    scene::Scene scene;
    scene::addTo(scene, std::move(plane), painted(Rgb::Constant(0.5f)));
    scene::addTo(scene, scene::translated(scene::icosphere(0.5f, 2), Vec3(0.3f, 0.8f, 0)),
                 painted(Rgb::Constant(0.5f)));
    return scene;
  };
  BakeOptions options = small();
  options.kind = TransferKind::Shadowed;
  const float inner = 2.0f * (kSide - 1) / kSide;
  const TransferField vertices =
      bakeOrDie(underBall(scene::gridPlane(inner, inner, kSide - 1, kSide - 1)), options);
  const TransferField texels =
      bakeOrDie(underBall(scene::gridPlane(2, 2, 1, 1)), options, {{{0, kSide, kSide}}, {}});
  const MeshTransfer &grid = texels.meshes[0], &points = vertices.meshes[0];
  ASSERT_EQ(grid.layout, Layout::Texels);
  std::size_t compared = 0;
  for (std::size_t t = 0; t < grid.receiverCount(); ++t)
    for (std::size_t v = 0; v < points.receiverCount(); ++v) {
      if ((points.positions[v] - grid.positions[t]).norm() > 1e-4f) continue;
      ++compared;
      for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(grid.vectors[t * 9 + i], points.vectors[v * 9 + i], 1e-3);
    }
  EXPECT_EQ(compared, grid.receiverCount());
}

TEST(Bake, TellsOfReceiversInsideAMesh) {
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(1, 2), painted(Rgb::Constant(0.5f)));
  scene::addTo(scene, scene::icosphere(0.3f, 1), painted(Rgb::Constant(0.5f)));
  const auto baked = bakeScene(scene, small());
  ASSERT_TRUE(baked);
  bool told = false;
  for (const Finding& finding : baked->findings)
    if (finding.code == "receivers-inside") {
      told = true;
      EXPECT_EQ(finding.count, 42u);
    }
  EXPECT_TRUE(told);
  // The ball inside is black, and the one outside is as if there were nothing inside it.
  for (const float value : baked->value.meshes[1].vectors) EXPECT_EQ(value, 0.0f);
}

TEST(Bake, RefusesWhatMakesNoSense) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1, 0));
  for (const auto& spoil : std::vector<std::function<void(BakeOptions&)>>{
           [](BakeOptions& o) { o.bands = 0; }, [](BakeOptions& o) { o.bands = 11; },
           [](BakeOptions& o) { o.directions = 3; }, [](BakeOptions& o) { o.bounces = -1; },
           [](BakeOptions& o) { o.energyThreshold = NAN; }}) {
    BakeOptions options = small();
    spoil(options);
    const auto field = bakeScene(scene, options);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().kind, ErrorKind::BadUsage);
  }
  const auto field = bakeScene(scene, small(), {{{5, 8, 8}}, {}});
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().kind, ErrorKind::BadUsage);
}

TEST(Bake, CanBeCancelled) {
  const scene::Scene scene = mixedScene();
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  ASSERT_TRUE(receivers);
  const auto field =
      bake(scene, *rays, *receivers, small(), [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::macro
