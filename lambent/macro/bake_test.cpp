// Properties of a bake: the same whatever the threads or the memory, linear, coloured, diagnosed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "lambent/macro/test_bake.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/coefficients.h"

namespace lambent::macro {
namespace {

void expectSameNumbers(const transfer::SimulatedField& a, const transfer::SimulatedField& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  EXPECT_EQ(a.passEnergy, b.passEnergy);
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(meshOf(a, m).vectors, meshOf(b, m).vectors);
    EXPECT_EQ(meshOf(a, m).matrices, meshOf(b, m).matrices);
  }
}

TEST(Bake, IsTheSameAtAnyThreadCount) {
  BakeOptions options = small();
  options.threads = 1;
  const transfer::SimulatedField one = bakeOrDie(mixedScene(), options);
  options.threads = 4;
  const transfer::SimulatedField four = bakeOrDie(mixedScene(), options);
  expectSameNumbers(one, four);
}

TEST(Bake, IsTheSameWhenHitsDoNotFitAndAreCastAgain) {
  BakeOptions options = small();
  const transfer::SimulatedField kept = bakeOrDie(mixedScene(), options);
  options.hitMemory = 0;
  const transfer::SimulatedField again = bakeOrDie(mixedScene(), options);
  expectSameNumbers(kept, again);
}

TEST(Bake, SeedsGiveIndependentErrorsOfTheSameSize) {
  BakeOptions options = small();
  options.kind = transfer::Kind::Shadowed;
  const transfer::SimulatedField a = bakeOrDie(mixedScene(), options);
  options.seed = 1;
  const transfer::SimulatedField b = bakeOrDie(mixedScene(), options);
  EXPECT_NE(meshOf(a, 0).vectors, meshOf(b, 0).vectors);
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < meshOf(a, 0).vectors.size(); ++k) {
    difference += std::pow(meshOf(a, 0).vectors[k] - meshOf(b, 0).vectors[k], 2);
    size += std::pow(meshOf(a, 0).vectors[k], 2);
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
  const transfer::SimulatedField field = bakeOrDie(mixedScene(), small());
  const BakedMesh floor = meshOf(field, 0);
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
  const transfer::SimulatedField field = bakeOrDie(mixedScene(), small());
  EXPECT_FALSE(meshOf(field, 0).vectors.empty());
  EXPECT_TRUE(meshOf(field, 0).matrices.empty());
  EXPECT_FALSE(meshOf(field, 2).vectors.empty());
  EXPECT_EQ(meshOf(field, 2).matrices.size(), meshOf(field, 2).receiverCount() * 3 * 9 * 9);
  EXPECT_TRUE(std::holds_alternative<transfer::NoTransfer>(field.meshes[3]));
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
        options.kind = transfer::Kind::Shadowed;
        const transfer::SimulatedField alone = bakeOrDie(scene, options, placement);
        options.kind = transfer::Kind::Interreflected;
        options.bounces = bounces;
        const transfer::SimulatedField plain = bakeOrDie(scene, options, placement);
        options.keepShadowed = true;
        const transfer::SimulatedField both = bakeOrDie(scene, options, placement);
        expectSameNumbers(both, plain);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
          const BakedMesh a = meshOf(alone, m);
          const BakedMesh kept = meshOf(both, m, transfer::Kind::Shadowed);
          EXPECT_EQ(kept.channels, a.channels);
          EXPECT_EQ(kept.vectors, a.vectors);
          EXPECT_EQ(kept.matrixChannels, a.matrixChannels);
          EXPECT_EQ(kept.matrices, a.matrices);
          EXPECT_TRUE(meshOf(plain, m, transfer::Kind::Shadowed).positions.empty());
        }
        EXPECT_FALSE(meshOf(both, 0, transfer::Kind::Shadowed).vectors.empty());
        EXPECT_FALSE(meshOf(both, 2, transfer::Kind::Shadowed).matrices.empty());
        // Only what has a colour of its own, or is lit by a painted mirror, needs three channels.
        EXPECT_EQ(meshOf(both, 2, transfer::Kind::Shadowed).matrixChannels, isPainted ? 3 : 1);
        EXPECT_EQ(meshOf(both, 2).matrixChannels, 3);
      }
}

TEST(Bake, StopsWhenAPassHasLittleEnergy) {
  BakeOptions options = small();
  options.bounces = 50;
  options.energyThreshold = 1e-4;
  const transfer::SimulatedField field = bakeOrDie(mixedScene(), options);
  EXPECT_LT(field.bounces, 20);
  EXPECT_LE(field.passEnergy.back(), 1e-4 * field.passEnergy.front());
}

TEST(Bake, ColourCostsChannelsOnlyWhereItIsNeeded) {
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(1, 1), painted(Rgb(0.9f, 0.5f, 0.1f)));
  BakeOptions options = small();
  options.kind = transfer::Kind::Shadowed;
  EXPECT_EQ(meshOf(bakeOrDie(scene, options), 0).channels, 3);
  scene.materials[0].diffuse = Rgb::Constant(0.5f);
  EXPECT_EQ(meshOf(bakeOrDie(scene, options), 0).channels, 1);
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
  options.kind = transfer::Kind::Shadowed;
  const float inner = 2.0f * (kSide - 1) / kSide;
  const transfer::SimulatedField vertices =
      bakeOrDie(underBall(scene::gridPlane(inner, inner, kSide - 1, kSide - 1)), options);
  const transfer::SimulatedField texels =
      bakeOrDie(underBall(scene::gridPlane(2, 2, 1, 1)), options, {{{0, kSide, kSide}}, {}});
  const BakedMesh grid = meshOf(texels, 0), points = meshOf(vertices, 0);
  ASSERT_TRUE(grid.onTexels);
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
  for (const float value : meshOf(baked->value, 1).vectors) EXPECT_EQ(value, 0.0f);
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
