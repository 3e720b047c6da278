#include "lambent/texel_layout/lay_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lambent/atlas/welded_surface.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/transport/texel_charts.h"

namespace lambent::texel_layout {
namespace {

/// A box near the middle of a floor of two triangles without texture coordinates, and a wall far
/// off that nothing stands before.
scene::Scene boxOnFloor() {
  scene::Scene scene;
  scene::Mesh floor = scene::gridPlane(8, 8, 1, 1);
  floor.uvs.clear();
  scene::addTo(scene, floor, {});
  scene::addTo(scene, scene::translated(scene::box(Vec3(1, 1, 1)), Vec3(0.3f, 0.5f, -0.2f)), {});
  return scene;
}

LaidOutScene laidOut(const scene::Scene& scene, const std::vector<std::uint32_t>& meshes,
                     const LayoutOptions& options) {
  const auto rays = trace::RayScene::build(scene);
  auto laid = layOut(scene, meshes, *rays, options, {});
  EXPECT_TRUE(laid) << laid.error().message;
  EXPECT_TRUE(laid->findings.empty());
  return std::move(laid->value);
}

void expectSound(const LaidOutScene& laid, const LayoutOptions& options) {
  std::size_t texels = 0;
  for (const transport::TexelGrid& grid : laid.grids) {
    const scene::Mesh& mesh = laid.scene.meshes[grid.mesh];
    EXPECT_EQ(scene::texelUvsOf(mesh).size(), mesh.positions.size());
    const Status sound = scene::checkUvs(mesh, grid.width, grid.height);
    EXPECT_TRUE(sound) << sound.error().message;
    texels += std::size_t(grid.width) * std::size_t(grid.height);
  }
  EXPECT_EQ(texels, laid.texels);
  EXPECT_LE(texels, options.budget);
  const auto receivers = transport::placeReceivers(laid.scene, {laid.grids, {}}, 1e-5f);
  ASSERT_TRUE(receivers) << receivers.error().message;
  EXPECT_TRUE(
      transport::chartFindings(laid.scene, *receivers).empty());  // gutters, and no tiny charts
}

TEST(LayOut, SurfacesStayWhatTheyAre) {
  scene::Scene scene = boxOnFloor();
  scene.meshes[1].colors.assign(scene.meshes[1].positions.size(), Rgb(0.2f, 0.4f, 0.6f));
  LayoutOptions options;
  options.budget = 4096, options.error = std::nullopt;
  const LaidOutScene laid = laidOut(scene, {0, 1}, options);
  expectSound(laid, options);
  EXPECT_FALSE(laid.error);
  for (std::uint32_t m = 0; m < 2; ++m) {
    const scene::Mesh &from = scene.meshes[m], &to = laid.scene.meshes[m];
    ASSERT_EQ(from.triangles.size(), to.triangles.size());
    EXPECT_EQ(from.uvs.empty(), to.texelUvs.empty());
    for (std::size_t t = 0; t < from.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = from.triangles[t][k], b = to.triangles[t][k];
        EXPECT_EQ(from.positions[a], to.positions[b]);
        EXPECT_EQ(from.normals[a], to.normals[b]);
        if (!from.uvs.empty()) {
          EXPECT_EQ(from.uvs[a], to.uvs[b]);
        }
      }
  }
  // As dense everywhere, but for gutters and whole sides of grids.
  for (const MeshLayout& mesh : laid.meshes) EXPECT_LT(mesh.finest, 1.05 * mesh.coarsest);
}

// Two floors side by side, and a box on one of them: that one gets the texels.
TEST(LayOut, TexelsGoWhereShadowsFall) {
  scene::Scene scene = boxOnFloor();
  scene::addTo(scene, scene::translated(scene::gridPlane(8, 8, 1, 1), Vec3(30, 0, 0)), {});
  LayoutOptions options;
  options.budget = 8192;
  const LaidOutScene laid = laidOut(scene, {0, 2}, options);
  expectSound(laid, options);
  ASSERT_EQ(laid.meshes.size(), 2u);
  EXPECT_GT(laid.meshes[0].finest, 4.0 * laid.meshes[1].finest);

  LayoutOptions uniform = options;
  uniform.error = std::nullopt;
  EXPECT_LT(laidOut(scene, {0, 2}, uniform).meshes[0].finest, 0.8 * laid.meshes[0].finest);
}

// Nothing hides light from a ball, and still it takes texels to be round.
TEST(LayOut, NormalsThatTurnTakeTexels) {
  LayoutOptions options;
  const LaidOutScene laid = laidOut(scene::sceneOf(scene::icosphere(1, 4)), {0}, options);
  expectSound(laid, options);
  EXPECT_FALSE(laid.spent);
  EXPECT_LT(*laid.error, 0.01);
  EXPECT_GT(laid.meshes[0].coarsest, 6.0);
  EXPECT_LT(laid.meshes[0].finest, 40.0);
}

// The back of a sheet lies beside its front, and looks the other way.
TEST(LayOut, BacksLieBesideTheirFronts) {
  scene::Scene scene = boxOnFloor();
  scene::Mesh sheet = scene::gridPlane(2, 2, 3, 3);
  for (Vec2& uv : sheet.uvs) uv *= 5.0f;
  sheet = scene::rotated(std::move(sheet), Vec3::UnitX(), 0.7f);
  scene::addTo(scene, scene::translated(scene::withBacks(std::move(sheet)), Vec3(0, 3, 0)), {});
  LayoutOptions options;
  options.budget = 8192;
  const LaidOutScene laid = laidOut(scene, {0, 2}, options);
  expectSound(laid, options);
  const scene::Mesh& mesh = laid.scene.meshes[2];
  EXPECT_TRUE(scene::hasBacks(mesh));
  const transport::TexelGrid& grid = laid.grids[1];
  EXPECT_EQ(grid.width, 2 * grid.height);
  const auto receivers = transport::placeReceivers(laid.scene, {laid.grids, {}}, 1e-5f);
  ASSERT_TRUE(receivers);
  const auto& place = receivers->meshes[2];
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.height; ++x) {
      const std::size_t front = std::size_t(y * grid.width + x);
      const std::size_t back = front + std::size_t(grid.height);
      ASSERT_EQ(place.covered[front], place.covered[back]);
      if (!place.covered[front]) continue;
      const std::uint32_t f = place.receiverOfTexel[front], b = place.receiverOfTexel[back];
      EXPECT_LT((receivers->positions[f] - receivers->positions[b]).norm(), 1e-4f);
      EXPECT_LT((receivers->normals[f] + receivers->normals[b]).norm(), 1e-4f);
    }
}

// A texture of a mesh without coordinates is not there, before and after.
TEST(LayOut, BringsNoTextureThatWasNotThere) {
  scene::Scene scene = boxOnFloor();
  scene::Texture& red = scene.textures.emplace_back();
  red.width = red.height = 1, red.rgba = {255, 0, 0, 255};
  scene.materials[0].baseColorTexture = scene.materials[1].baseColorTexture = 0;
  const LaidOutScene laid = laidOut(scene, {0, 1}, {.budget = 4096, .error = std::nullopt});
  for (std::uint32_t m = 0; m < 2; ++m)
    EXPECT_TRUE((scene::baseColorAt(scene, m, 0, 0.3f, 0.3f) ==
                 scene::baseColorAt(laid.scene, m, 0, 0.3f, 0.3f))
                    .all());
}

TEST(LayOut, EndsWhereTheErrorIsMet) {
  LayoutOptions options;
  options.budget = 65536, options.error = 0.05;
  const LaidOutScene coarse = laidOut(boxOnFloor(), {0, 1}, options);
  expectSound(coarse, options);
  EXPECT_FALSE(coarse.spent);
  EXPECT_LT(*coarse.error, 0.06);
  EXPECT_LT(coarse.texels, options.budget / 4);
  options.error = 0.01;
  const LaidOutScene fine = laidOut(boxOnFloor(), {0, 1}, options);
  EXPECT_LT(*fine.error, 0.6 * *coarse.error);
  EXPECT_GT(fine.texels, 2 * coarse.texels);
}

/// Root mean square, over the borders between charts, of how far apart the normals are that both
/// sides interpolate of those of their receivers; and how far those of neighbours are on the whole.
struct Steps {
  double rms = 0.0;
  std::size_t places = 0;
};
Steps stepsAlongBorders(const LaidOutScene& laid, bool beyond) {
  std::vector<transport::TexelGrid> grids = laid.grids;
  if (!beyond)
    for (transport::TexelGrid& grid : grids) grid.beyond.clear();
  const auto receivers = transport::placeReceivers(laid.scene, {grids, {}}, 1e-5f);
  EXPECT_TRUE(receivers);
  const scene::Mesh& mesh = laid.scene.meshes[0];
  const atlas::WeldedSurface surface = atlas::weldedSurface(mesh);
  const auto interpolated = [&](std::uint32_t t, std::uint32_t a, float share, std::uint32_t b) {
    Vec3 weights = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      if (surface.triangles[t][std::size_t(k)] == a) weights[k] = 1.0f - share;
      if (surface.triangles[t][std::size_t(k)] == b) weights[k] = share;
    }
    const auto around =
        transport::receiversAround(laid.scene, *receivers, 0, t, weights.y(), weights.z());
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < around.count; ++k)
      sum += around.weight[k] * receivers->normals[around.receiver[k]];
    return sum;
  };
  Steps steps;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t n = surface.neighbours[t][k];
      if (n == atlas::kNoTriangle || n < t) continue;
      const std::uint32_t a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      const auto uvAt = [&](std::uint32_t triangle, std::uint32_t welded) {
        for (std::size_t c = 0; c < 3; ++c)
          if (surface.triangles[triangle][c] == welded)
            return scene::texelUvsOf(mesh)[mesh.triangles[triangle][c]];
        return Vec2(Vec2::Zero());
      };
      if (uvAt(t, a) == uvAt(n, a) && uvAt(t, b) == uvAt(n, b)) continue;
      for (const float share : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f}) {
        sum += double((interpolated(t, a, share, b) - interpolated(n, a, share, b)).squaredNorm());
        ++steps.places;
      }
    }
  steps.rms = std::sqrt(sum / double(steps.places));
  return steps;
}

// Across a seam of a smooth surface light goes on, as far as it is linear between texels.
TEST(LayOut, SidesOfASeamAgree) {
  for (const std::size_t budget : {std::size_t(2048), std::size_t(8192)}) {
    LayoutOptions options;
    options.budget = budget, options.error = std::nullopt;
    const LaidOutScene laid = laidOut(scene::sceneOf(scene::icosphere(1, 4)), {0}, options);
    const Steps with = stepsAlongBorders(laid, true), without = stepsAlongBorders(laid, false);
    EXPECT_GT(with.places, 500u);
    const double texel = 1.0 / laid.meshes[0].coarsest;  // by which normals turn, radians
    EXPECT_LT(with.rms, 0.05 * texel) << without.rms;
    EXPECT_GT(without.rms, 0.2 * texel);
  }
}

TEST(LayOut, IsTheSameAtAnyNumberOfThreads) {
  LayoutOptions options;
  options.budget = 4096, options.threads = 1;
  const LaidOutScene one = laidOut(boxOnFloor(), {0, 1}, options);
  options.threads = 0;
  const LaidOutScene many = laidOut(boxOnFloor(), {0, 1}, options);
  EXPECT_EQ(one.error, many.error);
  for (std::size_t m = 0; m < 2; ++m)
    EXPECT_EQ(scene::texelUvsOf(one.scene.meshes[m]), scene::texelUvsOf(many.scene.meshes[m]));
}

// Loose triangles are charts of their own, for which there must be room with their gutters.
TEST(LayOut, WhatHasNoRoomIsLeftAsItIs) {
  scene::Scene scene = boxOnFloor();
  scene::Mesh dust;
  for (int i = 0; i < 400; ++i) {
    const Vec3 at(0.05f * float(i % 20), 3.0f, 0.05f * float(i / 20));
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0, 0, 0.01f), Vec3(0.01f, 0, 0)}) {
      dust.positions.push_back(at + corner);
      dust.normals.push_back(Vec3::UnitY());
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    dust.triangles.push_back({first, first + 1, first + 2});
  }
  scene::addTo(scene, dust, {});
  const auto rays = trace::RayScene::build(scene);
  LayoutOptions options;
  options.budget = 2048;
  const std::vector<std::uint32_t> all{0, 1, 2};
  const auto laid = layOut(scene, all, *rays, options, {});
  ASSERT_TRUE(laid) << laid.error().message;
  ASSERT_EQ(laid->findings.size(), 1u);
  EXPECT_EQ(laid->findings[0].code, "texels-no-room");
  EXPECT_TRUE(laid->value.scene.meshes[2].texelUvs.empty());
  EXPECT_EQ(laid->value.grids.size(), 2u);
  EXPECT_LE(laid->value.texels, options.budget);
}

}  // namespace
}  // namespace lambent::texel_layout
