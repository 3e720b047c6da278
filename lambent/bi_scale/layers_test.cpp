#include "lambent/bi_scale/layers.h"

#include <gtest/gtest.h>

#include "lambent/scene/coverage.h"
#include "lambent/scene/shapes.h"

namespace lambent::bi_scale {
namespace {

/// Black on its left half; red is 1 on the right one, green a half.
scene::Texture halfBlack() {
  scene::Texture mask;
  mask.width = mask.height = 64;
  mask.wrapU = mask.wrapV = scene::Wrap::ClampToEdge;
  for (int i = 0; i < 64 * 64; ++i)
    for (const int code : {255, 128, 0, 255})
      mask.rgba.push_back(std::uint8_t(i % 64 < 32 ? 0 : code));
  return mask;
}

TEST(AddLayer, WearsThePatchWhereTheMaskShowsIt) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 8, 8));
  const scene::Texture mask = halfBlack();
  const auto layer = addLayer(scene, 0, "pebbles", Rgb::Constant(0.25f), {mask, 0}, NoTint{});
  ASSERT_TRUE(layer && *layer);
  EXPECT_EQ((*layer)->mesh, 1u);
  // Half of the columns, and one that blends into them.
  EXPECT_EQ((*layer)->triangles.size(), 2u * 8u * 5u);
  const scene::Mesh& mesh = scene.meshes[1];
  EXPECT_TRUE(mesh.layer);
  EXPECT_FALSE(scene.meshes[0].layer);
  EXPECT_NE(mesh.name.find("pebbles"), std::string::npos);
  const scene::Material& material = scene::materialOf(scene, mesh);
  EXPECT_EQ(material.alphaMode, scene::AlphaMode::Blend);
  EXPECT_EQ(material.diffuse[0], 0.25f);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const scene::SurfacePoint point = scene::surfaceAt(scene, 1, t, 0.4f, 0.3f);
    const float right = point.uv.x() > 0.5f + 0.5f / 64 ? 1.0f : 0.0f;
    EXPECT_EQ(scene::coverageAt(scene, 1, t, 0.4f, 0.3f), right) << point.uv.x();
  }
}

TEST(AddLayer, OfAnEmptyChannelIsNone) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 8, 8));
  const scene::Texture mask = halfBlack();
  const auto layer = addLayer(scene, 0, "snow", Rgb::Ones(), {mask, 2}, NoTint{});
  ASSERT_TRUE(layer);
  EXPECT_FALSE(*layer);
  EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST(AddLayer, WithoutUvsNamesTheRemedy) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 8, 8));
  scene.meshes[0].uvs.clear();
  const scene::Texture mask = halfBlack();
  const auto layer = addLayer(scene, 0, "snow", Rgb::Ones(), {mask, 0}, NoTint{});
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().kind, ErrorKind::BadInput);
  EXPECT_NE(layer.error().message.find("unwrap it"), std::string::npos);
}

TEST(AddLayer, KeepsATintBesideTheMask) {
  scene::Material painted;
  painted.baseColorTexture = 0;
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 8, 8), painted);
  scene::Texture& red = scene.textures.emplace_back();
  red.width = red.height = 1;
  red.rgba = {200, 100, 50, 255};
  const scene::Texture mask = halfBlack();
  const auto layer = addLayer(scene, 0, "pebbles", Rgb::Ones(), {mask, 1}, OwnTint{});
  ASSERT_TRUE(layer && *layer);
  EXPECT_EQ(scene.textures[0].rgba, (std::vector<std::uint8_t>{200, 100, 50, 255}));
  const scene::Texture& made = scene.textures[1];
  EXPECT_EQ(made.width, 64);
  for (std::size_t i = 0; i < made.rgba.size(); i += 4) {
    EXPECT_EQ(made.rgba[i], 200);
    EXPECT_EQ(made.rgba[i + 3], i / 4 % 64 < 32 ? 0 : 128);
  }
}

TEST(SharesSeen, AreOfWhatLiesAboveFirst) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 8, 8));
  const scene::Texture mask = halfBlack();
  for (const int channel : {0, 1})
    ASSERT_TRUE(addLayer(scene, 0, "patch", Rgb::Ones(), {mask, channel}, NoTint{}));
  const std::vector<std::uint32_t> layers = {1, 2};
  const std::vector<double> shares = sharesSeen(scene, 0, layers);
  ASSERT_EQ(shares.size(), 3u);
  const double half = 128.0 / 255.0 / 2.0;
  EXPECT_NEAR(shares[0], 0.5, 2e-3);
  EXPECT_NEAR(shares[1], 0.5 - half, 2e-3);
  EXPECT_NEAR(shares[2], half, 2e-3);
  EXPECT_NEAR(sharesSeen(scene, 0, {})[0], 1.0, 1e-9);
}

}  // namespace
}  // namespace lambent::bi_scale
