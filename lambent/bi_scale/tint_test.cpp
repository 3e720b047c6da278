#include "lambent/bi_scale/tint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lambent/scene/shapes.h"

namespace lambent::bi_scale {
namespace {

/// Waves of a quarter to a half of the picture, in all three channels.
scene::Texture waves(int width, int height) {
  scene::Texture texture;
  texture.width = width, texture.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = 2.0 * kPi * (x + 0.5) / width, v = 2.0 * kPi * (y + 0.5) / height;
      for (const double wave : {std::sin(u), std::cos(u + v), std::sin(2.0 * v)})
        texture.rgba.push_back(std::uint8_t(std::lround(150.0 + 90.0 * wave)));
      texture.rgba.push_back(255);
    }
  return texture;
}

double mostApart(const scene::Texture& a, const scene::Texture& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    most = std::max(most, std::abs(double(a.rgba[i]) - double(b.rgba[i])));
  return most;
}

TEST(TintLaidOut, OverTheSameUvsIsTheSamePicture) {
  const scene::Mesh plane = scene::gridPlane(2, 2, 3, 3);
  const scene::Texture from = waves(64, 64);
  const scene::Texture to = laidOut(from, plane.uvs, plane, 16, 4096);
  ASSERT_EQ(to.width, 64) << "as fine as it was";
  ASSERT_EQ(to.height, 64);
  // Four samples of a bilinear surface stand for its middle, but for what it is curved there.
  EXPECT_LE(mostApart(from, to), 6.0);
}

TEST(TintLaidOut, ShowsWhereverItLiesWhatItShowedBefore) {
  const scene::Mesh plane = scene::gridPlane(2, 2, 4, 4);
  const scene::Texture from = waves(128, 96);
  // A quarter of the picture before, turned; small and in a corner now.
  std::vector<Vec2> before;
  scene::Mesh mesh = plane;
  for (std::size_t v = 0; v < plane.uvs.size(); ++v) {
    before.emplace_back(0.3f + 0.5f * plane.uvs[v].y(), 0.9f - 0.5f * plane.uvs[v].x());
    mesh.uvs[v] = Vec2(0.1f, 0.55f) + 0.4f * plane.uvs[v];
  }
  const scene::Texture to = laidOut(from, before, mesh, 16, 4096);
  // 64 × 48 texels of the picture over 0.4 × 0.4 of the square.
  EXPECT_EQ(to.width, int(std::ceil(std::sqrt(64.0 * 48.0) / 0.4)));
  double most = 0.0;
  for (float a = 0.01f; a < 1.0f; a += 0.049f)
    for (float b = 0.01f; b < 1.0f; b += 0.049f) {
      const Rgb was = scene::sampleBaseColor(from, Vec2(0.3f + 0.5f * b, 0.9f - 0.5f * a));
      const Rgb is = scene::sampleBaseColor(to, Vec2(0.1f + 0.4f * a, 0.55f + 0.4f * b));
      most = std::max(most, double((was - is).abs().maxCoeff()));
    }
  EXPECT_LT(most, 0.02);
}

TEST(TintLaidOut, WhatNobodyCoversContinuesWhatIsBeside) {
  scene::Mesh mesh = scene::gridPlane(2, 2, 1, 1);
  for (Vec2& uv : mesh.uvs) uv = Vec2(0.25f, 0.25f) + 0.5f * uv;
  scene::Texture even = waves(8, 8);
  for (std::size_t i = 0; i < even.rgba.size(); ++i) even.rgba[i] = std::uint8_t(i % 4 * 60 + 75);
  const scene::Texture to = laidOut(even, mesh.uvs, mesh, 64, 64);
  for (std::size_t i = 0; i < to.rgba.size(); i += 4) {
    EXPECT_EQ(to.rgba[i], 75);
    EXPECT_EQ(to.rgba[i + 1], 135);
    EXPECT_EQ(to.rgba[i + 2], 195);
    EXPECT_EQ(to.rgba[i + 3], 255);
  }
}

TEST(TintLaidOut, IsTheMeanWhereTexelsAreFew) {
  const scene::Mesh plane = scene::gridPlane(2, 2, 1, 1);
  scene::Texture chequers;
  chequers.width = chequers.height = 64;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      chequers.rgba.insert(chequers.rgba.end(), 4, (x + y) % 2 ? 255 : 0);
  const scene::Texture to = laidOut(chequers, plane.uvs, plane, 16, 32);
  ASSERT_EQ(to.width, 32);
  for (std::size_t i = 0; i < to.rgba.size(); i += 4)
    EXPECT_NEAR(to.rgba[i], 188, 6);  // ½, linear; more on a diagonal, which two triangles hold
}

scene::Scene colored(bool texture, bool vertices) {
  scene::Material material;
  material.diffuse = Rgb(0.4f, 0.2f, 0.1f);
  material.glossy = Rgb(0.4f, 0.2f, 0.1f);
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 2, 2), material);
  if (texture) scene.textures.push_back(waves(16, 16)), scene.materials[0].baseColorTexture = 0;
  if (vertices) scene.meshes[0].colors.assign(9, Rgb(1.0f, 0.5f, 0.25f));
  return scene;
}

bool holds(const Findings& findings, std::string_view code) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const Finding& each) { return each.code == code; });
}

TEST(WearPatch, WithoutATintNothingIsLeftButAFindingThatNamesTheRemedy) {
  scene::Scene scene = colored(true, true);
  const auto worn = wearPatch(scene, 0, "weave", Rgb::Constant(0.6f), NoTint{});
  ASSERT_TRUE(worn);
  ASSERT_TRUE(holds(*worn, "colours-replaced"));
  EXPECT_NE((*worn)[0].message.find("--tint own"), std::string::npos);
  EXPECT_TRUE(scene.meshes[0].colors.empty());
  const scene::Material& material = scene::materialOf(scene, scene.meshes[0]);
  EXPECT_EQ(material.name, "weave");
  EXPECT_EQ(material.baseColorTexture, -1);
  EXPECT_TRUE((material.diffuse == 0.6f).all());
  EXPECT_FALSE(material.isGlossy());
}

TEST(WearPatch, ItsOwnColoursAreTextureVerticesAndFactor) {
  for (const bool texture : {false, true})
    for (const bool vertices : {false, true}) {
      scene::Scene scene = colored(texture, vertices);
      const scene::SurfacePoint before = scene::surfaceAt(scene, 0, 3, 0.2f, 0.3f);
      const auto worn = wearPatch(scene, 0, "weave", Rgb::Constant(0.6f), OwnTint{});
      ASSERT_TRUE(worn);
      EXPECT_EQ(holds(*worn, "tint-even"), !texture && !vertices);
      // As much as it reflected in all, half of it by a lobe.
      const Rgb tint = scene::baseColorAt(scene, 0, 3, 0.2f, 0.3f);
      EXPECT_LT((tint - before.diffuse - before.glossy).abs().maxCoeff(), 1e-6f);
    }
}

TEST(WearPatch, APictureTakesThePlaceOfTheMeshsColours) {
  scene::Scene scene = colored(true, true);
  scene.textures.push_back(waves(32, 8));
  ASSERT_TRUE(wearPatch(scene, 0, "weave", Rgb::Constant(0.6f), PictureTint{1}));
  EXPECT_EQ(scene::materialOf(scene, scene.meshes[0]).baseColorTexture, 1);
  EXPECT_TRUE(scene.meshes[0].colors.empty());
  scene.meshes[0].uvs.clear();
  const auto refused = wearPatch(scene, 0, "weave", Rgb::Constant(0.6f), PictureTint{1});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  EXPECT_NE(refused.error().message.find("texture coordinates"), std::string::npos);
}

}  // namespace
}  // namespace lambent::bi_scale
