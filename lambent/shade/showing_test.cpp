// Which transfer is shown: against bakes of that kind, and against the switch of meso-structure.

#include "lambent/shade/showing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "lambent/macro/bake.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"
#include "lambent/shade/transfer_matrices.h"
#include "lambent/shade/unshadowed.h"
#include "lambent/transfer/encode.h"
#include "lambent/transfer/names.h"

namespace lambent::shade {
namespace {

using transfer::Encoding;
using transfer::Kind;
using transfer::Numbers;
using Response = transfer::SurfaceResponse<Numbers>;
using Surface = transfer::Surface<Numbers>;
using BiScale = transfer::BiScale<Numbers>;

/// A coloured room of every kind: a painted sphere at vertices, a floor on texels with a gutter and
/// vertex colours, a glossy sphere, a textured floor, a mirror.
scene::Scene everyKind() {
  scene::Scene scene;
  scene::Material painted, paintedFloor, glossy, textured, mirror;
  painted.diffuse = Rgb(0.8f, 0.5f, 0.3f);
  paintedFloor.diffuse = Rgb(0.5f, 0.6f, 0.7f);
  glossy.diffuse = Rgb::Constant(0.2f);
  glossy.glossy = Rgb(0.7f, 0.6f, 0.5f);
  glossy.lobeExponent = 20.0f;
  textured.diffuse = Rgb(0.9f, 0.7f, 0.6f);
  textured.baseColorTexture = 0;
  mirror.diffuse = Rgb::Zero();
  mirror.mirror = Rgb::Constant(0.9f);
  scene.materials = {painted, paintedFloor, glossy, textured, mirror};
  scene::Texture texture;
  texture.width = texture.height = 2;
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 255};
  scene.textures = {texture};

  scene.meshes = {test::sphere({0, 1.2f, 0}, 1.0f, 6), test::floor({0, 0, 0}, 3.0f),
                  test::sphere({2.2f, 1, 0}, 0.8f, 5), test::floor({0, -0.5f, 6.5f}, 3.0f),
                  test::sphere({-2.2f, 1, 0}, 0.8f, 5)};
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) scene.meshes[m].material = int(m);
  for (std::size_t m : {0u, 1u})
    for (const Vec3& at : scene.meshes[m].positions)
      scene.meshes[m].colors.push_back(Rgb(0.5f, 0.75f, 1.0f) -
                                       0.1f * at.cwiseAbs().cwiseMin(2.0f).array());
  // A gutter around the floor's texels.
  for (Vec2& uv : scene.meshes[1].uvs) uv = Vec2(0.2f, 0.2f) + 0.6f * uv;
  return scene;
}

asset::Asset baked(Kind kind, bool keepShadowed, Encoding encoding = Encoding::Float32) {
  asset::Asset asset;
  asset.scene = everyKind();
  macro::BakeOptions options;
  options.kind = kind;
  options.bands = 3;
  options.glossyBands = 4;
  options.directions = 256;
  options.bounces = 2;
  options.keepShadowed = keepShadowed;
  const auto rays = trace::RayScene::build(asset.scene);
  EXPECT_TRUE(rays);
  const auto receivers = transport::placeReceivers(asset.scene, {{{1, 7, 6}}, {}}, rays->offset());
  EXPECT_TRUE(receivers);
  const auto baked = macro::bake(asset.scene, *rays, *receivers, options, {});
  EXPECT_TRUE(baked) << baked.error().message;
  asset.transfer = transfer::encode(baked->value, encoding);
  return asset;
}

void expectSameNumbers(const Numbers& a, const Numbers& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.half, b.half);
  EXPECT_EQ(a.single, b.single);
  EXPECT_EQ(a.byte, b.byte);
  EXPECT_EQ(a.scales, b.scales);
}

void expectSame(const Response& a, const Response& b) {
  ASSERT_EQ(a.diffuse.has_value(), b.diffuse.has_value());
  if (a.diffuse) {
    EXPECT_EQ(a.diffuse->albedo, b.diffuse->albedo);
    EXPECT_EQ(a.diffuse->vectors.bands, b.diffuse->vectors.bands);
    EXPECT_EQ(a.diffuse->vectors.channels, b.diffuse->vectors.channels);
    expectSameNumbers(a.diffuse->vectors.numbers, b.diffuse->vectors.numbers);
  }
  ASSERT_EQ(a.glossy.has_value(), b.glossy.has_value());
  if (!a.glossy) return;
  EXPECT_TRUE((a.glossy->lobe.reflectance == b.glossy->lobe.reflectance).all());
  EXPECT_EQ(a.glossy->lobe.exponent, b.glossy->lobe.exponent);
  EXPECT_EQ(a.glossy->matrices.outBands, b.glossy->matrices.outBands);
  EXPECT_EQ(a.glossy->matrices.inBands, b.glossy->matrices.inBands);
  EXPECT_EQ(a.glossy->matrices.channels, b.glossy->matrices.channels);
  expectSameNumbers(a.glossy->matrices.numbers, b.glossy->matrices.numbers);
}

/// What a bare surface holds of the asset's own kind; null for a mirror.
const Response* own(const asset::Asset& asset, std::uint32_t mesh) {
  const auto* surface = std::get_if<Surface>(&asset.transfer.meshes[mesh]);
  return surface ? surface->responses.find(asset.transfer.kind) : nullptr;
}

constexpr std::uint32_t kMirror = 4;

TEST(Unshadowed, IsTheBakeOfThatKind) {
  for (const Encoding encoding : {Encoding::Float32, Encoding::Float16, Encoding::Snorm8}) {
    const asset::Asset whole = baked(Kind::Interreflected, false, encoding);
    const asset::Asset bare = baked(Kind::Unshadowed, false, encoding);
    for (std::uint32_t m = 0; m < kMirror; ++m) {
      SCOPED_TRACE(m);
      const Response made = unshadowedResponse(whole, m);
      if (m != 1) {
        expectSame(made, *own(bare, m));
        continue;
      }
      // The colour at a texel is interpolated twice over, once by each room: it may differ in its
      // last bits.
      const std::vector<float> a = decode(made.diffuse->vectors.numbers),
                               b = decode(own(bare, m)->diffuse->vectors.numbers);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_NEAR(a[k], b[k], encoding == Encoding::Float32 ? 1e-6 : 2e-3) << k;
    }
  }
}

TEST(Showing, WhatIsNotHeldFallsToTheNearestBelow) {
  const asset::Asset whole = baked(Kind::Interreflected, false);
  EXPECT_FALSE(offers(whole, Kind::Shadowed));
  EXPECT_TRUE(offers(whole, Kind::Unshadowed));
  EXPECT_TRUE(offers(whole, Kind::Interreflected));
  EXPECT_EQ(kindShown(whole.transfer.meshes[0], Showing::of(Kind::Shadowed)), Kind::Unshadowed);
  const Status status = checkHeld(whole, Showing::of(Kind::Shadowed));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadUsage);
  EXPECT_NE(status.error().message.find("unshadowed, interreflected"), std::string::npos);
  EXPECT_NE(status.error().message.find("--keep-shadowed"), std::string::npos);

  const asset::Asset shadowed = baked(Kind::Shadowed, false);
  EXPECT_TRUE(offers(shadowed, Kind::Shadowed));
  EXPECT_FALSE(offers(shadowed, Kind::Interreflected));
  for (const Showing& showing :
       {Showing{}, Showing::of(Kind::Shadowed), Showing::of(Kind::Interreflected)}) {
    EXPECT_EQ(kindShown(shadowed.transfer.meshes[2], showing), Kind::Shadowed);
    // As it is stored: nothing is copied.
    EXPECT_EQ(responseUnder(shadowed, 2, Kind::Shadowed).get(), own(shadowed, 2));
  }
  EXPECT_TRUE(checkHeld(shadowed, {}));
  EXPECT_TRUE(checkHeld(shadowed, Showing::of(Kind::Unshadowed)));
  EXPECT_FALSE(checkHeld(shadowed, Showing::of(Kind::Interreflected)));
  EXPECT_EQ(kindShown(shadowed.transfer.meshes[kMirror], Showing::of(Kind::Unshadowed)),
            Kind::Unshadowed);
}

TEST(Showing, KeptShadowedTransferIsAShadowedAsset) {
  const asset::Asset both = baked(Kind::Interreflected, true);
  const asset::Asset best = baked(Kind::Interreflected, false);
  const asset::Asset alone = baked(Kind::Shadowed, false);
  for (const Kind kind : transfer::kKinds) EXPECT_TRUE(offers(both, kind)) << int(kind);
  for (std::uint32_t m = 0; m < kMirror; ++m) {
    SCOPED_TRACE(m);
    expectSame(*responseUnder(both, m, Kind::Shadowed), *own(alone, m));
    EXPECT_EQ(kindShown(both.transfer.meshes[m], {}), Kind::Interreflected);
    expectSame(*responseUnder(both, m, Kind::Interreflected), *own(best, m));
  }
}

// What a picture shows under a choice is what it shows of an asset that was baked so.
TEST(Showing, PicturesAndExitRadianceFollowIt) {
  const asset::Asset both = baked(Kind::Interreflected, true);
  const light::Environment sky = test::sky();
  const sh::RgbCoefficients light = sky.project(3);
  const scene::Camera camera = test::cameraAt({1, 4, 12}, {0, 0, 1});
  for (const Kind kind : {Kind::Shadowed, Kind::Unshadowed}) {
    SCOPED_TRACE(transfer::nameOf(kind));
    const asset::Asset alone = baked(kind, false);
    PictureOptions options;
    options.width = options.height = 40;
    options.samples = 4;
    const auto best = reference::relitPicture(both, light, sky, camera, options);
    const auto expected = reference::relitPicture(alone, light, sky, camera, options);
    options.showing = Showing::of(kind);
    const auto chosen = reference::relitPicture(both, light, sky, camera, options);
    ASSERT_TRUE(best && expected && chosen);
    float most = 0.0f, change = 0.0f;
    for (std::size_t k = 0; k < chosen->pixels.size(); ++k) {
      most = std::max(most, (chosen->pixels[k] - expected->pixels[k]).abs().maxCoeff());
      change = std::max(change, (chosen->pixels[k] - best->pixels[k]).abs().maxCoeff());
    }
    EXPECT_LT(most, 1e-5f);
    EXPECT_GT(change, 0.05f);
    const Vec3 eye(1, 4, 12);
    for (std::uint32_t m = 0; m < both.transfer.meshes.size(); ++m) {
      const std::vector<Rgb> a = exitRadiance(both, m, light, {eye, Showing::of(kind)}),
                             b = exitRadiance(alone, m, light, {eye, {}});
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t p = 0; p < a.size(); ++p)
        EXPECT_LT((a[p] - b[p]).abs().maxCoeff(), 1e-5f) << m << ", " << p;
    }
  }
}

TEST(Kinds, NamesAreThere) {
  for (const Kind kind : transfer::kKinds)
    EXPECT_EQ(transfer::kindNamed(transfer::nameOf(kind)), kind);
  EXPECT_FALSE(transfer::kindNamed("Shadowed"));
}

asset::Asset patched(Encoding matrices) {
  asset::Asset asset;
  test::SpreadOptions options;
  options.tiles = Vec2(2, 2);
  options.matrices = matrices;
  options.shadowedBands = 4;
  options.channels = 3;
  test::addPatched(asset, test::sphere(Vec3::Zero(), 1.0f, 9), test::bumpyRtt(4, 4, 3, 4), options);
  return asset;
}

/// The turn into the frames by matrices, as a GPU keeps it, is the turn itself.
void expectTurns(const BiScale& biScale, int bands, const sh::RgbCoefficients& light, float near) {
  const transfer::Matrices<Numbers> rotations = rotationsIntoFrames(biScale, bands);
  EXPECT_EQ(rotations.outBands, bands);
  const std::vector<float> a = applyMatrices(rotations, light),
                           b = incidentLight(biScale, light, bands, Kind::Unshadowed);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], near) << k;
}

TEST(Unshadowed, RotationsTurnLightIntoTheFrames) {
  const sh::RgbCoefficients light = test::sky().project(4);
  for (const Encoding encoding : {Encoding::Float32, Encoding::Float16, Encoding::Snorm8}) {
    const asset::Asset asset = patched(encoding);
    for (const Kind kind : transfer::kKinds) EXPECT_TRUE(offers(asset, kind));
    expectTurns(std::get<BiScale>(asset.transfer.meshes[0]), 4, light,
                encoding == Encoding::Float32 ? 2e-5f : 4e-3f);
  }
  // Meso-structure without matrices holds the rotation alone.
  asset::Asset bare;
  test::addPatched(bare, test::sphere(Vec3::Zero(), 1.0f, 5), test::bumpyRtt(2, 2, 2, 3), {});
  EXPECT_FALSE(offers(bare, Kind::Shadowed));
  EXPECT_EQ(kindShown(bare.transfer.meshes[0], {}), Kind::Unshadowed);
  // A light of more bands than the patch takes.
  expectTurns(std::get<BiScale>(bare.transfer.meshes[0]), 3, test::sky().project(5), 4e-3f);
}

TEST(Showing, MesoStructureHasAKindOfItsOwn) {
  const asset::Asset asset = patched(Encoding::Float32);
  const sh::RgbCoefficients light = test::sky().project(4);
  const auto shown = [&](std::optional<Kind> surfaces, std::optional<Kind> mesoStructure) {
    ReceiverView view;
    view.showing.surfaces = surfaces;
    view.showing.mesoStructure = mesoStructure;
    return exitRadiance(asset, 0, light, view)[7][0];
  };
  const float off = shown({}, Kind::Unshadowed);
  const float shadowed = shown({}, Kind::Shadowed);
  const float best = shown({}, {});
  EXPECT_GT(std::abs(off - shadowed), 1e-3f);
  EXPECT_GT(std::abs(best - shadowed), 1e-3f);
  EXPECT_EQ(shown({}, Kind::Interreflected), best);
  EXPECT_EQ(shown(Kind::Unshadowed, Kind::Shadowed), shadowed);
  EXPECT_EQ(shown(Kind::Shadowed, Kind::Interreflected), best);
  EXPECT_EQ(shown(Kind::Interreflected, Kind::Unshadowed), off);
  ReceiverView all;
  all.showing = Showing::of(Kind::Shadowed);
  EXPECT_EQ(exitRadiance(asset, 0, light, all)[7][0], shadowed);
}

}  // namespace
}  // namespace lambent::shade
