// Bakes of surfaces with two sides against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/test_bake.h"
#include "lambent/scene/sheets.h"
#include "lambent/sh/basis.h"

namespace lambent::macro {
namespace {

/// Exit radiance under uniform light of radiance 1.
double inUniformLight(const BakedMesh& mesh, std::size_t receiver, int channel = 0) {
  const int told = mesh.channels == 1 ? 0 : channel;
  return mesh.vectors[(receiver * std::size_t(mesh.channels) + std::size_t(told)) *
                      std::size_t(sh::coefficientCount(mesh.bands))] *
         std::sqrt(4.0 * kPi);
}

TEST(TwoSides, AThinSheetInUniformLightReturnsItsAlbedoOnBoth) {
  const scene::Scene scene = scene::sceneOf(scene::withBacks(scene::gridPlane(1, 2, 4, 4)),
                                            painted(Rgb(0.9f, 0.5f, 0.2f)));
  for (const Kind kind : {Kind::Shadowed, Kind::Interreflected}) {
    BakeOptions options = small();
    options.kind = kind;
    const auto baked = bakeScene(scene, options);
    ASSERT_TRUE(baked);
    EXPECT_TRUE(baked->findings.empty());
    const BakedMesh sheet = meshOf(baked->value, 0);
    ASSERT_EQ(sheet.receiverCount(), 50u);
    for (std::size_t r = 0; r < sheet.receiverCount(); ++r)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(inUniformLight(sheet, r, c), scene.materials[0].diffuse[c], 1e-5);
  }
}

TEST(TwoSides, AShellGathersLightWithinAndIsConvexWithout) {
  // The fraction s of a sphere: within, every point has ρ(1−s)/(1−ρs); without, ρ.
  const double s = 0.5, rho = 0.6;
  scene::Scene scene = scene::sceneOf(scene::withBacks(scene::bowl(1, float(s), 64, 32)),
                                      painted(Rgb::Constant(float(rho))));
  BakeOptions options;
  options.directions = 2048;
  options.bands = 2;
  options.bounces = 12;
  const BakedMesh shell = meshOf(bakeOrDie(scene, options), 0);
  const std::size_t fronts = shell.receiverCount() / 2;
  double within = 0.0;
  std::size_t counted = 0;
  for (std::size_t r = 0; r < fronts; ++r) {
    EXPECT_NEAR(inUniformLight(shell, r + fronts), rho, 2e-3) << "outside, vertex " << r;
    if (shell.positions[r].y() > -0.05f) continue;  // the faceted rim
    within += inUniformLight(shell, r), ++counted;
  }
  EXPECT_NEAR(within / double(counted), rho * (1 - s) / (1 - rho * s), 4e-3);
}

TEST(TwoSides, ASheetsUndersideLightsWhatLiesBelow) {
  // A disc of radius R at the height h above a speck of ground hides F = R²/(R²+h²) of its cosine.
  // From the underside, which sees the whole lower hemisphere, comes ρ: ground has ρ'(1 − F + F ρ).
  const double radius = 1.0, height = 0.8, rho = 0.7, ground = 0.5;
  scene::Mesh disc;
  disc.positions = {Vec3(0, float(height), 0)};
  const int slices = 256;
  for (std::uint32_t k = 0; k < slices; ++k) {
    const double angle = 2 * kPi * k / slices;
    disc.positions.emplace_back(float(radius * std::cos(angle)), float(height),
                                float(-radius * std::sin(angle)));
    disc.triangles.push_back({0, k + 1, (k + 1) % slices + 1});
  }
  disc.normals.assign(disc.positions.size(), Vec3::UnitY());
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(0.01f, 0.01f, 1, 1), painted(Rgb::Constant(float(ground))));
  scene::addTo(scene, scene::withBacks(disc), painted(Rgb::Constant(float(rho))));
  BakeOptions options;
  options.directions = 32768;
  options.bands = 2;
  options.bounces = 1;
  const auto field = bakeOrDie(scene, options);
  const double hidden = radius * radius / (radius * radius + height * height);
  const BakedMesh speck = meshOf(field, 0), sheet = meshOf(field, 1);
  for (std::size_t r = 0; r < speck.receiverCount(); ++r)
    EXPECT_NEAR(inUniformLight(speck, r), ground * (1 - hidden + hidden * rho), 2e-3);
  for (std::size_t r = 0; r < sheet.receiverCount(); ++r)
    EXPECT_NEAR(inUniformLight(sheet, r), rho, 1e-3);
}

TEST(TwoSides, TheBackThatFacesTheLightIsAsTheFrontOfItsTwin) {
  const auto sceneWith = [](const scene::Mesh& sheet) {
    scene::Scene scene;
    scene::addTo(scene, scene::gridPlane(4, 4, 8, 8), painted(Rgb::Constant(0.5f)));
    scene::addTo(scene, sheet, painted(Rgb(0.8f, 0.1f, 0.1f)));
    return scene;
  };
  const scene::Mesh front = scene::translated(
      scene::rotated(scene::gridPlane(1, 1, 3, 3), Vec3::UnitX(), 1.2f), Vec3(0, 0.8f, 0));
  const auto one = bakeOrDie(sceneWith(scene::withBacks(front)), small());
  const auto other = bakeOrDie(sceneWith(scene::withBacks(scene::flipped(front))), small());
  const BakedMesh ground = meshOf(one, 0), groundOther = meshOf(other, 0);
  ASSERT_EQ(ground.vectors.size(), groundOther.vectors.size());
  // Which corner of a triangle speaks for a hit is drawn, and drawn otherwise.
  for (std::size_t i = 0; i < ground.vectors.size(); ++i)
    EXPECT_NEAR(ground.vectors[i], groundOther.vectors[i], 2e-3f);
  const BakedMesh sheet = meshOf(one, 1), sheetOther = meshOf(other, 1);
  const std::size_t half = sheet.vectors.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    EXPECT_NEAR(sheet.vectors[i], sheetOther.vectors[i + half], 2e-3f);
    EXPECT_NEAR(sheet.vectors[i + half], sheetOther.vectors[i], 2e-3f);
  }
}

}  // namespace
}  // namespace lambent::macro
