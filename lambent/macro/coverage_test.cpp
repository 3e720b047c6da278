// Bakes of surfaces that are there in parts alone, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/test_bake.h"
#include "lambent/scene/sheets.h"
#include "lambent/sh/basis.h"

namespace lambent::macro {
namespace {

using scene::AlphaMode;

double exitUnderUniform(const BakedMesh& mesh, std::size_t receiver) {
  return mesh.vectors[receiver * std::size_t(mesh.channels) *
                      std::size_t(sh::coefficientCount(mesh.bands))] *
         std::sqrt(4.0 * kPi);
}

/// A speck of ground of albedo 0.5 at the middle below a square sheet of this material.
scene::Scene canopy(const scene::Material& leaf, float side, float height) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(0.01f, 0.01f, 1, 1), painted(Rgb::Constant(0.5f)));
  scene::addTo(
      scene,
      scene::withBacks(scene::translated(scene::gridPlane(side, side, 4, 4), Vec3(0, height, 0))),
      leaf);
  return scene;
}

/// The share of the cosine at the middle below a square of this half side over its height.
double squareFactor(double x) {
  const double along = x / std::sqrt(1 + x * x);
  return 4 / (2 * kPi) * 2 * along * std::atan(along);
}

double groundUnder(const scene::Scene& scene, Kind kind, int bounces) {
  BakeOptions options;
  options.kind = kind;
  options.directions = 16384;
  options.bands = 2;
  options.bounces = bounces;
  const BakedMesh ground = meshOf(bakeOrDie(scene, options), 0);
  double mean = 0.0;
  for (std::size_t r = 0; r < ground.receiverCount(); ++r)
    mean += exitUnderUniform(ground, r) / double(ground.receiverCount());
  return mean;
}

TEST(Coverage, LightFallsThroughHoles) {
  // Stripes: every second one is a hole. Of the half that is there the ground sees ρ below.
  scene::Material leaf = painted(Rgb::Constant(0.6f));
  leaf.alphaMode = AlphaMode::Mask;
  leaf.baseColorTexture = 0;
  const double factor = squareFactor(4.0);
  for (const int holes : {0, 1, 2}) {
    scene::Scene scene = canopy(leaf, 8, 1);
    scene::Texture stripes;
    stripes.width = 1024, stripes.height = 1;
    for (int x = 0; x < 1024; ++x)
      stripes.rgba.insert(stripes.rgba.end(),
                          {255, 255, 255, std::uint8_t(x / 2 % 2 < holes ? 0 : 255)});
    scene.textures = {stripes};
    const double hidden = factor * (1 - 0.5 * holes);
    EXPECT_NEAR(groundUnder(scene, Kind::Shadowed, 0), 0.5 * (1 - hidden), 6e-3) << holes;
    EXPECT_NEAR(groundUnder(scene, Kind::Interreflected, 1), 0.5 * (1 - hidden + hidden * 0.6),
                6e-3)
        << holes;
  }
}

TEST(Coverage, AVeilPassesWhatItDoesNotHold) {
  const double factor = squareFactor(2.0);
  for (const float opacity : {0.0f, 0.25f, 1.0f}) {
    scene::Material leaf = painted(Rgb::Constant(0.6f));
    leaf.alphaMode = AlphaMode::Blend;
    leaf.opacity = opacity;
    const scene::Scene scene = canopy(leaf, 4, 1);
    const double hidden = factor * double(opacity);
    EXPECT_NEAR(groundUnder(scene, Kind::Shadowed, 0), 0.5 * (1 - hidden), 1.5e-3) << opacity;
    EXPECT_NEAR(groundUnder(scene, Kind::Interreflected, 1), 0.5 * (1 - hidden + hidden * 0.6),
                2e-3)
        << opacity;
  }
}

TEST(Coverage, VeilsBehindEachOtherMultiply) {
  scene::Material gauze = painted(Rgb::Zero());
  gauze.alphaMode = AlphaMode::Blend;
  gauze.opacity = 0.5f;
  scene::Scene scene = canopy(gauze, 40, 1);
  for (const float height : {1.1f, 1.2f})
    scene::addTo(scene, scene::translated(scene::gridPlane(40, 40, 1, 1), Vec3(0, height, 0)),
                 gauze);
  const double factor = squareFactor(20.0);
  EXPECT_NEAR(groundUnder(scene, Kind::Shadowed, 0), 0.5 * (1 - factor * (1 - 0.125)), 2e-3);
}

TEST(Coverage, APaneTintsWhatItPasses) {
  scene::Material pane = painted(Rgb::Zero());
  pane.transmitted = Rgb(0.9f, 0.5f, 0.1f);
  BakeOptions options = small();
  options.kind = Kind::Shadowed;
  options.directions = 16384;
  const BakedMesh ground = meshOf(bakeOrDie(canopy(pane, 40, 1), options), 0);
  ASSERT_EQ(ground.channels, 3);
  const double factor = squareFactor(20.0);
  const auto coefficients = std::size_t(sh::coefficientCount(ground.bands));
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(ground.vectors[c * coefficients] * std::sqrt(4.0 * kPi),
                0.5 * (1 - factor * (1 - double(pane.transmitted[int(c)]))), 2e-3);
}

TEST(Coverage, InAFurnaceAVeilOfWhiteIsNotSeen) {
  // Everything white under uniform light of 1, with all bounces, sends 1 out, however much of the
  // veil is there. What is missing is what bounces beyond the last.
  scene::Material veil = painted(Rgb::Ones());
  veil.alphaMode = AlphaMode::Blend;
  veil.opacity = 0.5f;
  scene::Scene scene = canopy(veil, 3, 0.5f);
  scene.materials[0].diffuse = Rgb::Ones();
  BakeOptions options = small();
  options.directions = 4096;
  options.bounces = 8;
  const auto field = bakeOrDie(scene, options);
  for (std::size_t m = 0; m < 2; ++m) {
    const BakedMesh mesh = meshOf(field, m);
    for (std::size_t r = 0; r < mesh.receiverCount(); ++r)
      EXPECT_NEAR(exitUnderUniform(mesh, r), 1.0, 2e-3) << m;
  }
}

}  // namespace
}  // namespace lambent::macro
