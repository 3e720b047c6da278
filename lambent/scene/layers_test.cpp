#include "lambent/scene/layers.h"

#include <gtest/gtest.h>

#include "lambent/scene/coverage.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

/// Of a row of texels, high as one.
Texture maskOf(const std::vector<int>& reds) {
  Texture mask;
  mask.width = int(reds.size()), mask.height = 1;
  mask.wrapU = mask.wrapV = Wrap::ClampToEdge;
  for (const int red : reds)
    for (const int code : {red, 255 - red, 0, 255}) mask.rgba.push_back(std::uint8_t(code));
  return mask;
}

/// A strip of n squares along x in the unit square of UVs, each cut in two.
Mesh strip(int n) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2; ++j) {
      mesh.positions.push_back(Vec3(float(i), float(j), 0.0f));
      mesh.normals.push_back(Vec3::UnitZ());
      mesh.uvs.push_back(Vec2(float(i) / float(n), 1.0f - float(j)));
    }
  for (std::uint32_t i = 0; i < std::uint32_t(n); ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

TEST(Layers, HoldTheTrianglesThatTheMaskTouches) {
  const Texture texture = masked(nullptr, maskOf({0, 0, 0, 0, 255, 255, 255, 255}), 0);
  const Mesh base = strip(8);
  Mesh layer = base;
  const std::vector<std::uint32_t> from = makeLayer(layer, trianglesWithAlpha(base, texture));
  EXPECT_TRUE(layer.layer);
  // The right half, and what blends into it: from the middle of the last black texel on.
  ASSERT_EQ(layer.triangles.size(), 10u);
  ASSERT_EQ(layer.positions.size(), 12u);
  ASSERT_EQ(from.size(), 12u);
  for (std::size_t v = 0; v < 12; ++v) {
    EXPECT_GE(layer.positions[v].x(), 3.0f);
    EXPECT_EQ(layer.positions[v], base.positions[from[v]]);
  }
  EXPECT_TRUE(trianglesWithAlpha(base, masked(nullptr, maskOf({0, 0}), 0)).empty());
  EXPECT_EQ(trianglesWithAlpha(base, masked(nullptr, maskOf({1, 1}), 0)).size(), 16u);
}

TEST(Layers, AreThereAsTheMaskSays) {
  Scene scene;
  const Texture mask = maskOf({0, 64, 255, 255});
  scene.textures = {masked(nullptr, mask, 0), masked(nullptr, mask, 1)};
  scene.materials.resize(2);
  for (int m = 0; m < 2; ++m) {
    scene.materials[std::size_t(m)].alphaMode = AlphaMode::Blend;
    scene.materials[std::size_t(m)].baseColorTexture = m;
    scene.meshes.push_back(strip(1));
    scene.meshes.back().material = m;
  }
  // At the centre of the second texel, u 3/8, on the lower edge.
  EXPECT_NEAR(coverageAt(scene, 0, 0, 0.375f, 0.0f), 64.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(coverageAt(scene, 1, 0, 0.375f, 0.0f), 191.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(coverageAt(scene, 0, 0, 0.875f, 0.0f), 1.0f, 1e-6f);
}

TEST(Layers, KeepTheColoursThatTheyMask) {
  Texture color;
  color.width = 2, color.height = 2;
  color.wrapU = Wrap::MirroredRepeat;
  color.rgba = {10, 20, 30, 255, 40, 50, 60, 255, 70, 80, 90, 0, 100, 110, 120, 255};
  const Texture made = masked(&color, maskOf({0, 255}), 0);
  EXPECT_EQ(made.wrapU, Wrap::MirroredRepeat);
  EXPECT_EQ(made.rgba, (std::vector<std::uint8_t>{10, 20, 30, 0, 40, 50, 60, 255,  //
                                                  70, 80, 90, 0, 100, 110, 120, 255}));
}

TEST(Layers, AreFoundOnTheirPlacesUppermostFirst) {
  Scene scene;
  scene.meshes = {strip(4), strip(4), strip(4)};
  Mesh& lower = scene.meshes[1];
  Mesh& upper = scene.meshes[2];
  lower.layer = upper.layer = true;
  lower.triangles.erase(lower.triangles.begin());
  for (Triangle& t : upper.triangles) t = {t[2], t[0], t[1]};

  const Layers layers(scene);
  EXPECT_TRUE(layers.any());
  EXPECT_EQ(layers.above(0, 0, 0.2f, 0.3f).size(), 1u);
  const auto places = layers.above(0, 5, 0.2f, 0.3f);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].mesh, 2u);
  EXPECT_EQ(places[1].mesh, 1u);
  const Vec3 sought = surfaceAt(scene, 0, 5, 0.2f, 0.3f).position;
  for (const Layers::Place& place : places)
    EXPECT_LT(
        (surfaceAt(scene, place.mesh, place.triangle, place.u, place.v).position - sought).norm(),
        1e-6f);
  std::swap(scene.meshes[0].triangles[5][0], scene.meshes[0].triangles[5][1]);
  EXPECT_TRUE(layers.above(0, 5, 0.2f, 0.3f).empty()) << "it looks the other way";
  scene.meshes.resize(1);
  EXPECT_FALSE(Layers(scene).any());
}

}  // namespace
}  // namespace lambent::scene
