#include "lambent/bi_scale/spread_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lambent/asset/check.h"
#include "lambent/scene/coverage.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/synthesis/patch_lay.h"
#include "lambent/transfer/encode.h"
#include "lambent/work/thread_limit.h"

namespace lambent::bi_scale {
namespace {

/// Flat stripes and spots, B_i = ρ(u)/π Â_l y_i(+z).
using BiScale = transfer::BiScale<transfer::Numbers>;

/// Square with `height` 16: then a quarter turn leaves it as it is.
transfer::EncodedRtt paintedRtt(int bands = 3, int height = 12) {
  transfer::SimulatedRtt rtt;
  rtt.name = "spots";
  rtt.width = 16, rtt.height = height, rtt.views = 2, rtt.bands = bands;
  rtt.size = Vec2(0.16f, 0.01f * float(height));
  const sh::ZonalMoments cosine = sh::clampedCosine(bands);
  std::vector<double> y(std::size_t(bands) * bands);
  sh::evaluate(bands, Vec3d(0, 0, 1), y);
  rtt.values.resize(y.size() * rtt.planeSize());
  for (int i = 0; i < bands * bands; ++i)
    for (int row = 0; row < rtt.height; ++row)
      for (int x = 0; x < rtt.width; ++x) {
        const double spot = std::sin(2 * kPi * x / 16) * std::sin(2 * kPi * row / height);
        for (int view = 0; view < 4; ++view)
          for (int c = 0; c < 3; ++c)
            rtt.values[rtt.index(i, x, row, view % 2, view / 2) + c] =
                float((0.5 + 0.3 * spot - 0.1 * c) / kPi * cosine[sh::bandOf(i)] * y[i]);
      }
  return transfer::encode(rtt, transfer::Encoding::Float16);
}

SpreadOptions small() {
  SpreadOptions options;
  options.mesoVertices = 6000;
  options.atlas.size = 256;
  options.transfer.bands = 3;
  options.transfer.directions = 256;
  options.transfer.bounces = 1;
  options.patchWidth = 0.5f;
  options.layout = Layout::Pieces;
  return options;
}

Spread spreadOrDie(const scene::Scene& scene, const SpreadOptions& options) {
  auto spread = spreadPatch(scene, paintedRtt(), options);
  EXPECT_TRUE(spread) << spread.error().message;
  return spread ? std::move(spread->value) : Spread{};
}

TEST(SpreadPatch, FlapsOfAScanDoNotCutTheSurfaceAndAreSaid) {
  const scene::Mesh torus = scene::torus(1, 0.4f, 40, 20);
  scene::Mesh scan = torus;
  for (std::uint32_t t = 0; t < 400; t += 40) {
    const auto [a, b, c] = torus.triangles[t];
    scan.triangles.push_back({a, b, c});
    scan.triangles.push_back({b, a, c});
  }
  const auto clean = spreadPatch(scene::sceneOf(torus), paintedRtt(), small());
  const auto repaired = spreadPatch(scene::sceneOf(scan), paintedRtt(), small());
  ASSERT_TRUE(clean && repaired);
  EXPECT_EQ(repaired->value.reports[0].charts, clean->value.reports[0].charts);
  const auto said = std::find_if(repaired->findings.begin(), repaired->findings.end(),
                                 [](const Finding& f) { return f.code == "flaps-dropped"; });
  ASSERT_NE(said, repaired->findings.end());
  EXPECT_EQ(said->count, 10u);
}

TEST(SpreadPatch, TrianglesThatAreLargeBesideThePatchAreCutAndItIsSaid) {
  SpreadOptions options = small();
  options.layout = Layout::Lattice;
  const auto spread =
      spreadPatch(scene::sceneOf(scene::box(Vec3(2, 2, 2), 1)), paintedRtt(3, 16), options);
  ASSERT_TRUE(spread);
  const SpreadReport& report = spread->value.reports[0];
  EXPECT_GT(report.vertices, 500u);
  EXPECT_EQ(report.singularities, 8u);  // of quarter turns, at the corners
  EXPECT_EQ(report.continued, 1.0);
  EXPECT_LT(report.squeezed, 0.1);
  const auto said = std::find_if(spread->findings.begin(), spread->findings.end(),
                                 [](const Finding& f) { return f.code == "edges-cut"; });
  ASSERT_NE(said, spread->findings.end());
  EXPECT_GT(said->count, 500u);
}

TEST(SpreadPatch, MakesAnAssetThatCanBeWritten) {
  const Spread spread = spreadOrDie(scene::sceneOf(scene::torus(1, 0.4f, 40, 20)), small());
  const Status sound = asset::checkForWriting(spread.asset);
  EXPECT_TRUE(sound) << sound.error().message;
  ASSERT_EQ(spread.reports.size(), 1u);
  const SpreadReport& report = spread.reports[0];
  EXPECT_NEAR(report.area, 4 * kPi * kPi * 0.4, 0.3);
  EXPECT_NEAR(report.patches, report.area / (0.5 * 0.375), 0.1);
  EXPECT_EQ(report.singularities, 0u);  // a torus can be combed
  EXPECT_GE(report.stretch, 1.0);
  EXPECT_GT(report.usedArea, 0.3);
  const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
  ASSERT_TRUE(biScale.patch.idMap());
  EXPECT_EQ(biScale.patch.idMap()->width, 256);
  EXPECT_NEAR(biScale.patch.scale, 0.5f / 0.16f, 1e-5f);
  EXPECT_FALSE(biScale.matrices.holds(transfer::Kind::Shadowed));
  EXPECT_TRUE(biScale.matrices.holds(transfer::Kind::Interreflected));
}

TEST(SpreadPatch, VerticesThatWereOneKeepOneFrameAndOneMatrix) {
  const Spread spread = spreadOrDie(scene::sceneOf(scene::icosphere(1, 3)), small());
  const scene::Mesh& mesh = spread.asset.scene.meshes[0];
  const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
  ASSERT_GT(mesh.positions.size(), 642u);  // charts doubled some
  const std::vector<float> matrices =
      decode(biScale.matrices.find(transfer::Kind::Interreflected)->numbers);
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
    EXPECT_LT((biScale.tangents[v] - biScale.tangents[std::size_t(one)]).norm(), 1e-5f);
    for (int k = 0; k < 81; ++k)
      EXPECT_NEAR(matrices[v * 81 + k], matrices[std::size_t(one) * 81 + k], 0.02f);
  }
  EXPECT_GT(doubled, 0u);
}

TEST(SpreadPatch, IsTheSameAtAnyThreadCount) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1, 3));
  const auto ids = [&](std::size_t threads) {
    const work::ThreadLimit limit(threads);
    const Spread spread = spreadOrDie(scene, small());
    const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
    return std::pair(biScale.patch.idMap()->ids,
                     biScale.matrices.find(transfer::Kind::Interreflected)->numbers.byte);
  };
  EXPECT_EQ(ids(1), ids(4));
}

TEST(SpreadPatch, WhatRepeatsItselfIsLaidAsALattice) {
  SpreadOptions options = small();
  options.layout = Layout::Automatic;
  const Spread spread = spreadOrDie(scene::sceneOf(scene::icosphere(1, 3)), options);
  const SpreadReport& report = spread.reports[0];
  EXPECT_EQ(report.layout, Layout::Lattice);
  EXPECT_EQ(report.symmetry.cells(), 2) << "half a period along both axes";
  EXPECT_EQ(report.symmetry.turns, 2);
  EXPECT_EQ(report.singularities, 4u);
  EXPECT_EQ(report.continued, 1.0);
  EXPECT_EQ(report.flipped, 0.0);
  const Status sound = asset::checkForWriting(spread.asset);
  EXPECT_TRUE(sound) << sound.error().message;
  // Where charts meet the patch lies the same way, or the other way round.
  const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
  const std::vector<std::uint32_t>& source = spread.atlases[0].sourceVertex;
  std::size_t same = 0, turned = 0;
  for (std::size_t v = 642; v < source.size(); ++v) {
    const float agreement = biScale.tangents[v].dot(biScale.tangents[source[v]]);
    same += agreement > 0.9f, turned += agreement < -0.9f;
  }
  EXPECT_GT(turned, 0u);
  EXPECT_GT(double(same + turned), 0.9 * double(source.size() - 642));
}

TEST(SpreadPatch, AnAssetAloneTellsHowItsPatchLies) {
  for (const int turns : {2, 4}) {
    SpreadOptions options = small();
    options.layout = Layout::Lattice;
    const auto spread = spreadPatch(scene::sceneOf(scene::icosphere(1, 4)),
                                    paintedRtt(3, turns == 4 ? 16 : 12), options);
    ASSERT_TRUE(spread) << spread.error().message;
    const auto& [asset, reports, atlases] = spread->value;
    ASSERT_EQ(reports[0].symmetry.turns, turns);
    const auto lay = synthesis::patchLay(
        asset.scene.meshes[0], std::get<BiScale>(asset.transfer.meshes[0]).tangents, 0.2f);
    EXPECT_EQ(lay.turns, turns);
    EXPECT_EQ(lay.singularities.size(), std::size_t(2 * turns)) << "as many as a sphere must have";
    EXPECT_EQ(lay.singularities.size(), reports[0].singularities);
    for (const auto& each : lay.singularities) EXPECT_EQ(each.index, 1);
    EXPECT_GT(lay.cuts.size(), 0u);
  }
}

TEST(SpreadPatch, ALatticeHasTheSamePlacesAtAnyThreadCount) {
  SpreadOptions options = small();
  options.layout = Layout::Lattice;
  const auto ids = [&](std::size_t threads) {
    const work::ThreadLimit limit(threads);
    const Spread spread = spreadOrDie(scene::sceneOf(scene::icosphere(1, 3)), options);
    const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
    return std::pair(biScale.patch.idMap()->ids, biScale.tangents);
  };
  EXPECT_EQ(ids(1), ids(4));
}

TEST(SpreadPatch, OwnUvsRepeatThePatchAWholeNumberOfTimes) {
  SpreadOptions options = small();
  options.placement = Placement::OwnUvs;
  const Spread spread = spreadOrDie(scene::sceneOf(scene::torus(1, 0.4f, 40, 20)), options);
  const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
  EXPECT_FALSE(biScale.patch.idMap());
  const Vec2 tiles = biScale.patch.tiles();
  EXPECT_EQ(tiles.x(), std::round(tiles.x()));
  EXPECT_EQ(tiles.y(), std::round(tiles.y()));
  EXPECT_NEAR(tiles.x() * spread.reports[0].patchWidth, 2 * kPi * 1.05, 0.6);
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
  const Spread spread = spreadOrDie(scene, options);
  const auto* bare =
      std::get_if<transfer::Surface<transfer::Numbers>>(&spread.asset.transfer.meshes[0]);
  ASSERT_TRUE(bare);
  EXPECT_FALSE(bare->responses.find(spread.asset.transfer.kind)->diffuse->vectors.numbers.empty());
  EXPECT_TRUE(std::holds_alternative<BiScale>(spread.asset.transfer.meshes[1]));
  EXPECT_EQ(spread.asset.scene.materials.size(), 2u);
  EXPECT_EQ(spread.asset.scene.materials[spread.asset.scene.meshes[1].material].name, "spots");
}

// Triangles keep their sequence when a surface is laid out anew: at the same place of each the tint
// is what the mesh showed before.
TEST(SpreadPatch, ATintStaysWhereItWasOnTheSurface) {
  scene::Material painted;
  painted.diffuse = Rgb(0.9f, 0.8f, 0.7f);
  painted.baseColorTexture = 0;
  scene::Scene scene = scene::sceneOf(scene::uvSphere(1, 48, 32), painted);
  scene::Texture& texture = scene.textures.emplace_back();
  texture.width = 128, texture.height = 64;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x)
      for (const double wave : {std::sin(2 * kPi * x / 128), std::cos(2 * kPi * y / 64), 0.5, 2.0})
        texture.rgba.push_back(std::uint8_t(std::min(255.0, 140 + 100 * wave)));
  SpreadOptions options = small();
  options.transfer.kind = transfer::Kind::Shadowed;
  const Spread plain = spreadOrDie(scene, options);
  options.tint = OwnTint{};
  for (const Layout layout : {Layout::Pieces, Layout::Lattice}) {
    options.layout = layout;
    const Spread tinted = spreadOrDie(scene, options);
    EXPECT_TRUE(asset::checkForWriting(tinted.asset));
    EXPECT_FALSE(tinted.asset.scene.meshes[0].colors.empty()) << "the material's factor";
    ASSERT_EQ(tinted.asset.scene.textures.size(), 1u);
    EXPECT_GT(tinted.asset.scene.textures[0].width, 64);
    double most = 0.0, sum = 0.0;
    std::size_t count = 0;
    for (std::uint32_t t = 0; t < scene.meshes[0].triangles.size(); ++t)
      for (const auto& [u, v] : {std::pair(0.33f, 0.33f), {0.05f, 0.9f}, {0.0f, 0.5f}}) {
        const scene::SurfacePoint point = scene::surfaceAt(scene, 0, t, u, v);
        // About the poles the whole width of the picture lies on a few texels.
        if (std::abs(point.position.y()) > 0.9f) continue;
        const Rgb was = point.diffuse;
        const double apart =
            double((scene::baseColorAt(tinted.asset.scene, 0, t, u, v) - was).abs().maxCoeff());
        most = std::max(most, apart), sum += apart, ++count;
      }
    EXPECT_LT(most, 0.1);
    EXPECT_LT(sum / double(count), 0.01);
    // What is hidden has no colour.
    if (layout != Layout::Pieces) continue;
    const auto bytes = [](const Spread& spread) {
      const BiScale& biScale = std::get<BiScale>(spread.asset.transfer.meshes[0]);
      return biScale.matrices.find(transfer::Kind::Shadowed)->numbers.byte;
    };
    EXPECT_EQ(bytes(tinted), bytes(plain));
  }
  EXPECT_EQ(plain.asset.scene.textures.size(), 0u);
}

TEST(SpreadPatch, ByItsOwnUvsAMeshKeepsItsTextureAsItIs) {
  scene::Material painted;
  painted.baseColorTexture = 0;
  scene::Scene scene = scene::sceneOf(scene::torus(1, 0.4f, 40, 20), painted);
  scene::Texture& texture = scene.textures.emplace_back();
  texture.width = texture.height = 2;
  texture.rgba.assign(16, 200);
  texture.encoded = {1, 2, 3};
  SpreadOptions options = small();
  options.placement = Placement::OwnUvs;
  options.tint = OwnTint{};
  const Spread spread = spreadOrDie(scene, options);
  ASSERT_EQ(spread.asset.scene.textures.size(), 1u);
  EXPECT_EQ(spread.asset.scene.textures[0].encoded, texture.encoded);
}

// The ground beside a red wall of weave gets red light.
TEST(SpreadPatch, WhatATintedSurfaceSendsOnHasItsColour) {
  scene::Material red;
  red.diffuse = Rgb(1.0f, 0.1f, 0.1f);
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(0.5f, 3), red);
  scene::addTo(scene, scene::translated(scene::gridPlane(4, 4, 8, 8), Vec3(0, -0.6f, 0)), {});
  SpreadOptions options = small();
  options.meshes = {0};
  options.albedo = Rgb::Constant(0.5f);
  const auto redness = [&](const Tint& tint) {
    options.tint = tint;
    const Spread spread = spreadOrDie(scene, options);
    const auto& ground =
        std::get<transfer::Surface<transfer::Numbers>>(spread.asset.transfer.meshes[1]);
    const auto& vectors = ground.responses.find(spread.asset.transfer.kind)->diffuse->vectors;
    const std::vector<float> numbers = decode(vectors.numbers);
    const std::size_t each = numbers.size() / 81, n = vectors.channels == 3 ? 9 : 0;
    EXPECT_EQ(each * 81, numbers.size());
    const std::size_t middle = 40 * 9 * std::size_t(vectors.channels);
    return double(numbers[middle] / numbers[middle + n]);
  };
  EXPECT_NEAR(redness(NoTint{}), 1.0, 1e-3);
  EXPECT_GT(redness(OwnTint{}), 1.01);
}

/// A ball, with UVs, before a wall; the mask's red is 1 on half of it.
struct Masked {
  scene::Scene scene;
  SpreadOptions options = small();
  Masked() {
    scene::addTo(scene, scene::uvSphere(1, 24, 16), {});
    scene::addTo(scene, scene::translated(scene::gridPlane(4, 4, 8, 8), Vec3(0, -1.2f, 0)), {});
    options.meshes = {0};
    scene::Texture& mask = options.mask;
    mask.width = 32, mask.height = 1;
    for (int x = 0; x < 32; ++x)
      for (const int code : {x < 16 ? 255 : 0, 0, 0, 255}) mask.rgba.push_back(std::uint8_t(code));
  }
};

TEST(SpreadPatch, ALayerLeavesWhatItLiesOnAsItWas) {
  Masked masked;
  transfer::EncodedRtt over = paintedRtt(3, 16);
  over.name = "squares";
  // Triangles as the narrower patch wants them, which are for both.
  SpreadOptions narrow = masked.options;
  narrow.patchWidth = 0.3f;
  prepare(masked.scene, over, narrow);
  const Spread alone = spreadOrDie(masked.scene, masked.options);
  masked.options.over = {{over, Rgb(0.9f, 0.2f, 0.1f), 0.3f}};
  const Spread both = spreadOrDie(masked.scene, masked.options);
  const Status sound = asset::checkForWriting(both.asset);
  EXPECT_TRUE(sound) << sound.error().message;
  ASSERT_EQ(both.asset.scene.meshes.size(), 3u);
  EXPECT_TRUE(both.asset.scene.meshes[2].layer);

  const auto matricesOf = [](const Spread& spread, std::uint32_t mesh) -> const BiScale& {
    return std::get<BiScale>(spread.asset.transfer.meshes[mesh]);
  };
  const auto bytesOf = [&](const Spread& spread) {
    return matricesOf(spread, 0).matrices.find(transfer::Kind::Interreflected)->numbers.byte;
  };
  EXPECT_EQ(bytesOf(both), bytesOf(alone));
  EXPECT_EQ(matricesOf(both, 0).patch.idMap()->ids, matricesOf(alone, 0).patch.idMap()->ids);
  const auto numbersOf = [](const Spread& spread) {
    const auto& ground =
        std::get<transfer::Surface<transfer::Numbers>>(spread.asset.transfer.meshes[1]);
    return ground.responses.find(spread.asset.transfer.kind)->diffuse->vectors.numbers.half;
  };
  EXPECT_EQ(numbersOf(both), numbersOf(alone)) << "light that bounces off is the base's";

  ASSERT_EQ(both.asset.transfer.rtts.size(), 2u);
  EXPECT_EQ(matricesOf(both, 2).patch.rtt, 1);
  ASSERT_EQ(both.reports.size(), 2u);
  EXPECT_EQ(both.reports[0].patch, "spots");
  EXPECT_EQ(both.reports[1].patch, "squares");
  EXPECT_NEAR(both.reports[0].share, 0.5, 0.01);
  EXPECT_NEAR(both.reports[1].share, 0.5, 0.01);
  EXPECT_NEAR(both.reports[1].patchWidth, 0.3f, 1e-6f);
  EXPECT_LT(both.reports[1].area, 0.65 * both.reports[0].area);
}

// Charts lie elsewhere, and so does the mask in the picture; on the surface it is where it was.
TEST(SpreadPatch, AMaskStaysWhereItWasOnTheSurface) {
  Masked masked;
  masked.options.transfer.kind = transfer::Kind::Unshadowed;
  for (const Layout layout : {Layout::Pieces, Layout::Lattice}) {
    masked.options.layout = layout;
    masked.options.over = {{paintedRtt(), Rgb::Constant(0.5f), std::nullopt}};
    const Spread spread = spreadOrDie(masked.scene, masked.options);
    const scene::Mesh& layer = spread.asset.scene.meshes[2];
    std::size_t there = 0, wrong = 0;
    for (std::uint32_t t = 0; t < layer.triangles.size(); ++t) {
      const scene::SurfacePoint point = scene::surfaceAt(spread.asset.scene, 2, t, 0.3f, 0.3f);
      if (std::abs(point.position.y()) > 0.95f) continue;  // all of it on a few texels
      const float alpha = scene::coverageAt(spread.asset.scene, 2, t, 0.3f, 0.3f);
      wrong += alpha > 0.1f && alpha < 0.9f;
      there += alpha >= 0.9f;
    }
    EXPECT_GT(there, layer.triangles.size() / 2);
    EXPECT_LT(wrong, layer.triangles.size() / 10) << "the borders of the mask";
    // The same patch, laid the same way.
    const auto& below = std::get<BiScale>(spread.asset.transfer.meshes[0]);
    const auto& above = std::get<BiScale>(spread.asset.transfer.meshes[2]);
    EXPECT_EQ(below.patch.idMap()->ids, above.patch.idMap()->ids);
  }
}

TEST(SpreadPatch, AMaskThatShowsAPatchNowhereIsSaid) {
  Masked masked;
  masked.options.transfer.kind = transfer::Kind::Unshadowed;
  masked.options.over.resize(2, {paintedRtt(), Rgb::Constant(0.5f), std::nullopt});
  const auto spread = spreadPatch(masked.scene, paintedRtt(), masked.options);
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->value.asset.scene.meshes.size(), 3u);
  EXPECT_TRUE(std::any_of(spread->findings.begin(), spread->findings.end(),
                          [](const Finding& f) { return f.code == "mask-empty"; }));
}

TEST(SpreadPatch, RefusesWhatCannotBe) {
  scene::Material mirror;
  mirror.mirror = Rgb::Ones();
  SpreadOptions options = small();
  auto refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1), mirror), paintedRtt(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  options.transfer.bands = 5;
  refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadUsage);
  options = small();
  options.meshes = {3};
  refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options);
  ASSERT_FALSE(refused);
  options = small();
  options.over.resize(4, {paintedRtt(), Rgb::Ones(), std::nullopt});
  refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadUsage);
  options.over.resize(1);
  options.over[0].rtt = paintedRtt(4);
  refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 1)), paintedRtt(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadUsage);
  options = small();
  int updates = 0;
  refused = spreadPatch(scene::sceneOf(scene::icosphere(1, 3)), paintedRtt(), options,
                        [&](const ProgressUpdate&) { return ++updates < 3; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::bi_scale
