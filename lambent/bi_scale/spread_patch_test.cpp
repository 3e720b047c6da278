#include "lambent/bi_scale/spread_patch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "lambent/asset/check.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"

namespace lambent::bi_scale {
namespace {

/// Flat stripes and spots, B_i = ρ(u)/π Â_l y_i(+z).
encode::EncodedRtt paintedRtt(int bands = 3) {
  meso::RadianceTransferTexture rtt;
  rtt.name = "spots";
  rtt.width = 16, rtt.height = 12, rtt.views = 2, rtt.bands = bands;
  rtt.size = Vec2(0.16f, 0.12f);
  const sh::ZonalMoments cosine = sh::clampedCosine(bands);
  std::vector<double> y(std::size_t(bands) * bands);
  sh::evaluate(bands, Vec3d(0, 0, 1), y);
  rtt.values.resize(y.size() * rtt.planeSize());
  for (int i = 0; i < bands * bands; ++i)
    for (int row = 0; row < rtt.height; ++row)
      for (int x = 0; x < rtt.width; ++x) {
        const double spot = std::sin(2 * kPi * x / 16) * std::sin(2 * kPi * row / 12);
        for (int view = 0; view < 4; ++view)
          for (int c = 0; c < 3; ++c)
            rtt.values[rtt.index(i, x, row, view % 2, view / 2) + c] =
                float((0.5 + 0.3 * spot - 0.1 * c) / kPi * cosine[sh::bandOf(i)] * y[i]);
      }
  return encode::encode(rtt, encode::Encoding::Float16);
}

SpreadOptions small() {
  SpreadOptions options;
  options.mesoVertices = 6000;
  options.atlas.size = 256;
  options.transfer.bands = 3;
  options.transfer.directions = 256;
  options.transfer.bounces = 1;
  options.patchWidth = 0.5f;
  return options;
}

Spread spreadOrDie(const scene::Scene& scene, const SpreadOptions& options, Findings& findings) {
  auto spread = spreadPatch(scene, paintedRtt(), options, {}, findings);
  EXPECT_TRUE(spread) << spread.error().message;
  return spread ? std::move(*spread) : Spread{};
}

TEST(SpreadPatch, MakesAnAssetThatCanBeWritten) {
  Findings findings;
  const Spread spread =
      spreadOrDie(scene::sceneOf(scene::torus(1, 0.4f, 40, 20)), small(), findings);
  const Status sound = asset::checkForWriting(spread.asset);
  EXPECT_TRUE(sound) << sound.error().message;
  ASSERT_EQ(spread.reports.size(), 1u);
  const SpreadReport& report = spread.reports[0];
  EXPECT_NEAR(report.area, 4 * kPi * kPi * 0.4, 0.3);
  EXPECT_NEAR(report.patches, report.area / (0.5 * 0.375), 0.1);
  EXPECT_EQ(report.singularities, 0u);  // a torus can be combed
  EXPECT_GE(report.stretch, 1.0);
  EXPECT_GT(report.usedArea, 0.3);
  const encode::EncodedBiScale& patch = *spread.asset.transfer.meshes[0].biScale;
  ASSERT_TRUE(patch.idMap);
  EXPECT_EQ(patch.idMap->width, 256);
  EXPECT_NEAR(patch.scale, 0.5f / 0.16f, 1e-5f);
  EXPECT_TRUE(patch.shadowed.empty());
  EXPECT_FALSE(patch.interreflected.empty());
}

TEST(SpreadPatch, VerticesThatWereOneKeepOneFrameAndOneMatrix) {
  Findings findings;
  const Spread spread = spreadOrDie(scene::sceneOf(scene::icosphere(1, 3)), small(), findings);
  const scene::Mesh& mesh = spread.asset.scene.meshes[0];
  const encode::EncodedBiScale& patch = *spread.asset.transfer.meshes[0].biScale;
  ASSERT_GT(mesh.positions.size(), 642u);  // charts doubled some
  const std::vector<float> matrices = decode(patch.interreflected);
  const std::vector<std::uint32_t>& source = spread.atlases[0].sourceVertex;
  std::vector<std::int64_t> first(642, -1);
  std::size_t doubled = 0;
  for (std::size_t v = 0; v < source.size(); ++v) {
    std::int64_t& one = first[source[v]];
    if (one < 0) {
      one = std::int64_t(v);
      continue;
    }
    ++doubled;
    EXPECT_LT((patch.tangents[v] - patch.tangents[std::size_t(one)]).norm(), 1e-5f);
    for (int k = 0; k < 81; ++k)
      EXPECT_NEAR(matrices[v * 81 + k], matrices[std::size_t(one) * 81 + k], 0.02f);
  }
  EXPECT_GT(doubled, 0u);
}

TEST(SpreadPatch, IsTheSameAtAnyThreadCount) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1, 3));
  const auto ids = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Findings findings;
    const Spread spread = spreadOrDie(scene, small(), findings);
    return std::pair(spread.asset.transfer.meshes[0].biScale->idMap->ids,
                     spread.asset.transfer.meshes[0].biScale->interreflected.byte);
  };
  EXPECT_EQ(ids(1), ids(4));
}

TEST(SpreadPatch, OwnUvsRepeatThePatchAWholeNumberOfTimes) {
  SpreadOptions options = small();
  options.placement = Placement::OwnUvs;
  Findings findings;
  const Spread spread =
      spreadOrDie(scene::sceneOf(scene::torus(1, 0.4f, 40, 20)), options, findings);
  const encode::EncodedBiScale& patch = *spread.asset.transfer.meshes[0].biScale;
  EXPECT_FALSE(patch.idMap);
  EXPECT_EQ(patch.tiles.x(), std::round(patch.tiles.x()));
  EXPECT_EQ(patch.tiles.y(), std::round(patch.tiles.y()));
  EXPECT_NEAR(patch.tiles.x() * spread.reports[0].patchWidth, 2 * kPi * 1.05, 0.6);
  EXPECT_TRUE(asset::checkForWriting(spread.asset));
}

TEST(SpreadPatch, LeavesOtherMeshesAsTheyAre) {
  scene::Scene scene;
  scene::Material red;
  red.diffuse = Rgb(0.8f, 0.2f, 0.2f);
  scene::addTo(scene, scene::gridPlane(4, 4, 8, 8), red);
  scene::addTo(scene, scene::translated(scene::icosphere(0.5f, 2), Vec3(0, 0.6f, 0)), {});
  SpreadOptions options = small();
  options.meshes = {1};
  Findings findings;
  const Spread spread = spreadOrDie(scene, options, findings);
  EXPECT_FALSE(spread.asset.transfer.meshes[0].biScale);
  EXPECT_FALSE(spread.asset.transfer.meshes[0].vectors.empty());
  EXPECT_TRUE(spread.asset.transfer.meshes[1].biScale);
  EXPECT_EQ(spread.asset.scene.materials.size(), 2u);
  EXPECT_EQ(spread.asset.scene.materials[spread.asset.scene.meshes[1].material].name, "spots");
}

TEST(SpreadPatch, RefusesWhatCannotBe) {
  Findings findings;
  scene::Material mirror;
  mirror.mirror = Rgb::Ones();
  SpreadOptions options = small();
  auto refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1), mirror), paintedRtt(), options,
                             {}, findings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  options.transfer.bands = 5;
  refused =
      spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options, {}, findings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadUsage);
  options = small();
  options.meshes = {3};
  refused =
      spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options, {}, findings);
  ASSERT_FALSE(refused);
  options = small();
  int updates = 0;
  refused = spreadPatch(
      scene::sceneOf(scene::icosphere(1, 3)), paintedRtt(), options,
      [&](const ProgressUpdate&) { return ++updates < 3; }, findings);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::bi_scale
