// Which transfer a choice shows: against bakes of that kind, and against the macro switches.

#include "lambent/shade/transfer_choice.h"
#include "lambent/macro/bake.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "lambent/encode/encoded_field.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/macro_transport.h"
#include "lambent/shade/picture.h"
#include "lambent/shade/shade.h"
#include "lambent/shade/test_assets.h"
#include "lambent/shade/test_patches.h"

namespace lambent::shade {
namespace {

using encode::EncodedMesh;
using encode::Encoding;
using transport::TransferKind;

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

asset::Asset baked(TransferKind kind, bool keepShadowed, Encoding encoding = Encoding::Float32) {
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
  const auto field = macro::bake(asset.scene, *rays, *receivers, options, {});
  EXPECT_TRUE(field) << field.error().message;
  asset.transfer = encode::encode(field->value, encoding);
  return asset;
}

void expectSameNumbers(const encode::Numbers& a, const encode::Numbers& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.half, b.half);
  EXPECT_EQ(a.single, b.single);
  EXPECT_EQ(a.byte, b.byte);
  EXPECT_EQ(a.scales, b.scales);
}

void expectSame(const EncodedMesh& a, const EncodedMesh& b) {
  EXPECT_EQ(a.layout, b.layout);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.outBands, b.outBands);
  EXPECT_EQ(a.inBands, b.inBands);
  EXPECT_EQ(a.matrixChannels, b.matrixChannels);
  EXPECT_TRUE((a.glossy == b.glossy).all());
  EXPECT_EQ(a.positions, b.positions);
  expectSameNumbers(a.vectors, b.vectors);
  expectSameNumbers(a.matrices, b.matrices);
  EXPECT_TRUE(a.shadowed.empty());
}

TEST(TransferChoice, UnshadowedIsTheBakeOfThatKind) {
  for (const Encoding encoding : {Encoding::Float32, Encoding::Float16, Encoding::Snorm8}) {
    const asset::Asset whole = baked(TransferKind::Interreflected, false, encoding);
    const asset::Asset bare = baked(TransferKind::Unshadowed, false, encoding);
    for (std::uint32_t m = 0; m < whole.transfer.meshes.size(); ++m) {
      SCOPED_TRACE(m);
      const EncodedMesh chosen = chosenTransfer(whole, m, TransferChoice::Unshadowed);
      if (m != 1) {
        expectSame(chosen, bare.transfer.meshes[m]);
        continue;
      }
      // The colour at a texel is interpolated twice over, once by each room: it may differ in its
      // last bits.
      const std::vector<float> a = decode(chosen.vectors),
                               b = decode(bare.transfer.meshes[m].vectors);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_NEAR(a[k], b[k], encoding == Encoding::Float32 ? 1e-6 : 2e-3) << k;
    }
  }
}

TEST(TransferChoice, WithoutAKeptOneShadowedFallsToUnshadowed) {
  const asset::Asset whole = baked(TransferKind::Interreflected, false);
  EXPECT_FALSE(offers(whole, TransferChoice::Shadowed));
  EXPECT_TRUE(offers(whole, TransferChoice::Unshadowed));
  EXPECT_TRUE(offers(whole, TransferChoice::Interreflected));
  expectSame(chosenTransfer(whole, 0, TransferChoice::Shadowed),
             chosenTransfer(whole, 0, TransferChoice::Unshadowed));
  const Status status = checkTransfer(whole, TransferChoice::Shadowed);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadUsage);
  EXPECT_NE(status.error().message.find("unshadowed, interreflected"), std::string::npos);
  EXPECT_NE(status.error().message.find("--keep-shadowed"), std::string::npos);

  const asset::Asset shadowed = baked(TransferKind::Shadowed, false);
  EXPECT_TRUE(offers(shadowed, TransferChoice::Shadowed));
  EXPECT_FALSE(offers(shadowed, TransferChoice::Interreflected));
  for (const TransferChoice choice :
       {TransferChoice::Best, TransferChoice::Shadowed, TransferChoice::Interreflected}) {
    EXPECT_TRUE(isStored(shadowed, 2, choice));
    expectSame(chosenTransfer(shadowed, 2, choice), shadowed.transfer.meshes[2]);
  }
  EXPECT_FALSE(isStored(shadowed, 2, TransferChoice::Unshadowed));
  EXPECT_TRUE(isStored(shadowed, 4, TransferChoice::Unshadowed));  // a mirror
}

TEST(TransferChoice, KeptShadowedTransferIsAShadowedAsset) {
  const asset::Asset both = baked(TransferKind::Interreflected, true);
  const asset::Asset alone = baked(TransferKind::Shadowed, false);
  for (const TransferChoice choice :
       {TransferChoice::Unshadowed, TransferChoice::Shadowed, TransferChoice::Interreflected})
    EXPECT_TRUE(offers(both, choice)) << nameOf(choice);
  for (std::uint32_t m = 0; m < both.transfer.meshes.size(); ++m) {
    SCOPED_TRACE(m);
    expectSame(chosenTransfer(both, m, TransferChoice::Shadowed), alone.transfer.meshes[m]);
    EncodedMesh best = both.transfer.meshes[m];
    best.shadowed = {};
    expectSame(chosenTransfer(both, m, TransferChoice::Best), best);
    expectSame(chosenTransfer(both, m, TransferChoice::Interreflected), best);
  }
}

// What a picture shows under a choice is what it shows of an asset that was baked so.
TEST(TransferChoice, PicturesAndExitRadianceFollowIt) {
  const asset::Asset both = baked(TransferKind::Interreflected, true);
  const light::Environment sky = test::sky();
  const sh::RgbCoefficients light = sky.project(3);
  const scene::Camera camera = test::cameraAt({1, 4, 12}, {0, 0, 1});
  const Vec3 eye(1, 4, 12);
  for (const auto& [choice, kind] : {std::pair{TransferChoice::Shadowed, TransferKind::Shadowed},
                                     {TransferChoice::Unshadowed, TransferKind::Unshadowed}}) {
    SCOPED_TRACE(nameOf(choice));
    const asset::Asset alone = baked(kind, false);
    PictureOptions options;
    options.width = options.height = 40;
    options.samples = 4;
    const auto best = picture(both, light, sky, camera, options);
    const auto expected = picture(alone, light, sky, camera, options);
    options.transfer = choice;
    const auto chosen = picture(both, light, sky, camera, options);
    ASSERT_TRUE(best && expected && chosen);
    float most = 0.0f, change = 0.0f;
    for (std::size_t k = 0; k < chosen->pixels.size(); ++k) {
      most = std::max(most, (chosen->pixels[k] - expected->pixels[k]).abs().maxCoeff());
      change = std::max(change, (chosen->pixels[k] - best->pixels[k]).abs().maxCoeff());
    }
    EXPECT_LT(most, 1e-5f);
    EXPECT_GT(change, 0.05f);
    for (std::uint32_t m = 0; m < both.transfer.meshes.size(); ++m) {
      const std::vector<Rgb> a = exitRadiance(both, m, light, {eye, {}, {}, choice}),
                             b = exitRadiance(alone, m, light, {eye, {}, {}, TransferChoice::Best});
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t p = 0; p < a.size(); ++p)
        EXPECT_LT((a[p] - b[p]).abs().maxCoeff(), 1e-5f) << m << ", " << p;
    }
  }
}

TEST(TransferChoice, NamesAreThere) {
  for (const TransferChoice choice : {TransferChoice::Best, TransferChoice::Unshadowed,
                                      TransferChoice::Shadowed, TransferChoice::Interreflected})
    EXPECT_EQ(transferChoiceNamed(nameOf(choice)), choice);
  EXPECT_FALSE(transferChoiceNamed("Best"));
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

TEST(TransferChoice, OfMesoStructureIsTheMacroSwitch) {
  const sh::RgbCoefficients light = test::sky().project(4);
  for (const Encoding encoding : {Encoding::Float32, Encoding::Float16, Encoding::Snorm8}) {
    const asset::Asset asset = patched(encoding);
    for (const auto& [choice, macro] :
         {std::pair{TransferChoice::Unshadowed, MacroTransport::Off},
          {TransferChoice::Shadowed, MacroTransport::Shadowed},
          {TransferChoice::Interreflected, MacroTransport::Interreflected}}) {
      SCOPED_TRACE(nameOf(choice));
      EXPECT_TRUE(offers(asset, choice));
      const EncodedMesh chosen = chosenTransfer(asset, 0, choice);
      ASSERT_EQ(bestOf(*chosen.biScale),
                macro == MacroTransport::Off ? MacroTransport::Shadowed : macro);
      const std::vector<float> a = incidentLight(chosen, light, 4, {}),
                               b = incidentLight(asset.transfer.meshes[0], light, 4, macro);
      ASSERT_EQ(a.size(), b.size());
      const float near = choice != TransferChoice::Unshadowed ? 0.0f
                         : encoding == Encoding::Float32      ? 2e-5f
                                                              : 4e-3f;
      for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], near) << k;
    }
  }
}

TEST(TransferChoice, TheMacroSwitchWinsOverIt) {
  const asset::Asset asset = patched(Encoding::Float32);
  const sh::RgbCoefficients light = test::sky().project(4);
  const auto shown = [&](TransferChoice choice, std::optional<MacroTransport> macro) {
    View view;
    view.transfer = choice;
    view.biScale.macro = macro;
    return exitRadiance(asset, 0, light, view)[7][0];
  };
  const float off = shown(TransferChoice::Best, MacroTransport::Off);
  const float shadowed = shown(TransferChoice::Best, MacroTransport::Shadowed);
  const float best = shown(TransferChoice::Best, {});
  EXPECT_GT(std::abs(off - shadowed), 1e-3f);
  EXPECT_GT(std::abs(best - shadowed), 1e-3f);
  EXPECT_NEAR(shown(TransferChoice::Unshadowed, {}), off, 1e-5f);
  EXPECT_EQ(shown(TransferChoice::Shadowed, {}), shadowed);
  EXPECT_EQ(shown(TransferChoice::Interreflected, {}), best);
  EXPECT_EQ(shown(TransferChoice::Unshadowed, MacroTransport::Shadowed), shadowed);
  EXPECT_EQ(shown(TransferChoice::Shadowed, MacroTransport::Interreflected), best);
  EXPECT_EQ(shown(TransferChoice::Interreflected, MacroTransport::Off), off);
}

TEST(TransferChoice, MesoStructureWithoutMatricesHoldsTheRotationAlone) {
  asset::Asset asset;
  test::addPatched(asset, test::sphere(Vec3::Zero(), 1.0f, 5), test::bumpyRtt(2, 2, 2, 3), {});
  EXPECT_FALSE(offers(asset, TransferChoice::Shadowed));
  EXPECT_TRUE(isStored(asset, 0, TransferChoice::Best));
  EXPECT_FALSE(isStored(asset, 0, TransferChoice::Unshadowed));
  const EncodedMesh chosen = chosenTransfer(asset, 0, TransferChoice::Interreflected);
  EXPECT_EQ(chosen.biScale->bands, 3);
  const sh::RgbCoefficients light = test::sky().project(5);  // more than the patch takes
  const std::vector<float> a = incidentLight(chosen, light, 3, {}),
                           b = incidentLight(asset.transfer.meshes[0], light, 3, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 4e-3f) << k;
}

}  // namespace
}  // namespace lambent::shade
