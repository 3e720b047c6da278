#include "lambent/scene/coverage.h"

#include <gtest/gtest.h>

#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

/// A square whose texture is whole on its left half and has this alpha on its right one.
Scene halfSquare(std::uint8_t alpha, AlphaMode mode) {
  Scene scene = sceneOf(gridPlane(2, 2, 1, 1));
  Texture texture;
  texture.width = 64, texture.height = 1;
  for (int x = 0; x < 64; ++x)
    texture.rgba.insert(texture.rgba.end(), {255, 0, 0, x < 32 ? std::uint8_t(255) : alpha});
  scene.textures = {texture};
  scene.materials[0].baseColorTexture = 0;
  scene.materials[0].alphaMode = mode;
  return scene;
}

/// At a place of the square, −1 … 1 both ways.
float coverage(const Scene& scene, float x, float z) {
  for (std::uint32_t t = 0; t < 2; ++t) {
    const Mesh& mesh = scene.meshes[0];
    const auto [a, b, c] = mesh.triangles[t];
    Eigen::Matrix2f edges;
    const auto flat = [&](std::uint32_t v) {
      return Vec2(mesh.positions[v].x(), mesh.positions[v].z());
    };
    edges << flat(b) - flat(a), flat(c) - flat(a);
    const Vec2 uv = edges.inverse() * (Vec2(x, z) - flat(a));
    if (uv.minCoeff() < 0 || uv.sum() > 1) continue;
    EXPECT_TRUE(
        (passedAt(scene, 0, t, uv.x(), uv.y()) == 1 - coverageAt(scene, 0, t, uv.x(), uv.y()))
            .all());
    return coverageAt(scene, 0, t, uv.x(), uv.y());
  }
  ADD_FAILURE();
  return -1;
}

TEST(Coverage, AMaskIsThereOrIsNot) {
  Scene scene = halfSquare(100, AlphaMode::Mask);
  EXPECT_EQ(passingsOf(scene), std::vector{Passing::Holes});
  EXPECT_EQ(coverage(scene, -0.7f, 0.2f), 1.0f);
  EXPECT_EQ(coverage(scene, 0.6f, 0.3f), 0.0f);
  scene.materials[0].alphaCutoff = 100 / 255.0f;  // what is equal is there
  EXPECT_EQ(coverage(scene, 0.6f, 0.3f), 1.0f);
  EXPECT_EQ(passingsOf(scene), std::vector{Passing::Nothing});
  scene.materials[0].opacity = 0.9f;
  EXPECT_EQ(coverage(scene, 0.6f, 0.3f), 0.0f);
  EXPECT_EQ(coverage(scene, -0.6f, 0.3f), 1.0f);
  EXPECT_EQ(passingsOf(scene), std::vector{Passing::Holes});
}

TEST(Coverage, ABlendIsTheProductOfAllItsAlphas) {
  Scene scene = halfSquare(51, AlphaMode::Blend);
  EXPECT_EQ(passingsOf(scene), std::vector{Passing::Shares});
  EXPECT_FLOAT_EQ(coverage(scene, 0.6f, 0.3f), 0.2f);
  scene.materials[0].opacity = 0.5f;
  scene.meshes[0].alphas.assign(4, 0.5f);
  EXPECT_FLOAT_EQ(coverage(scene, 0.6f, 0.3f), 0.05f);
  EXPECT_FLOAT_EQ(coverage(scene, -0.6f, 0.3f), 0.25f);
}

TEST(Coverage, WhatIsOpaqueIsWholeWhateverItsPicturesSay) {
  Scene scene = halfSquare(0, AlphaMode::Opaque);
  scene.materials[0].opacity = 0.0f;
  EXPECT_EQ(coverage(scene, 0.6f, 0.3f), 1.0f);
  EXPECT_EQ(passingsOf(scene), std::vector{Passing::Nothing});
  EXPECT_EQ(passingsOf(halfSquare(255, AlphaMode::Blend)), std::vector{Passing::Nothing});
  EXPECT_EQ(passingsOf(halfSquare(255, AlphaMode::Mask)), std::vector{Passing::Nothing});
  // Without texture coordinates a texture has no place.
  Scene bare = halfSquare(0, AlphaMode::Mask);
  bare.meshes[0].uvs.clear();
  EXPECT_EQ(passingsOf(bare), std::vector{Passing::Nothing});
}

}  // namespace
}  // namespace lambent::scene
