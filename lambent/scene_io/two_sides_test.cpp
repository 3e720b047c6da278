// Which surfaces are given a back, and what becomes of it in a file.
#include "lambent/scene_io/two_sides.h"

#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/test_gltf.h"

namespace lambent::scene_io {
namespace {

scene::Material twoSided() {
  scene::Material material;
  material.doubleSided = true;
  return material;
}

/// The walls and the roof of a box without its floor.
scene::Mesh hood() {
  scene::Mesh mesh = scene::box(Vec3(1, 1, 1));
  std::erase_if(mesh.triangles,
                [&](const scene::Triangle& t) { return mesh.normals[t[0]].y() < -0.5f; });
  return mesh;
}

scene::Mesh lid() {
  scene::Mesh mesh = scene::box(Vec3(1, 1, 1));
  std::erase_if(mesh.triangles,
                [&](const scene::Triangle& t) { return mesh.normals[t[0]].y() > -0.5f; });
  return mesh;
}

class TwoSides : public testing::Test {
 protected:
  LoadedScene loaded(const scene::Scene& scene, Sides sides = Sides::AsFileSays) {
    const auto path = folder_ / "file.glb";
    EXPECT_TRUE(saveGlb(scene, path));
    LoadOptions options;
    options.sides = sides;
    auto result = load(path, options);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
  }
  TemporaryFolder folder_;
};

TEST_F(TwoSides, AnOpenSurfaceThatSaysSoIsGivenABack) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(1, 1, 2, 2), twoSided());
  scene::addTo(scene, scene::gridPlane(1, 1, 2, 2), {});
  const LoadedScene read = loaded(scene);
  expectSound(read.scene);
  EXPECT_TRUE(scene::hasBacks(read.scene.meshes[0]));
  EXPECT_FALSE(read.scene.materials[0].doubleSided);
  EXPECT_EQ(read.scene.meshes[0].positions.size(), 18u);
  EXPECT_EQ(read.scene.meshes[1].positions.size(), 9u);
  EXPECT_EQ(countOf(read.findings, "two-sided"), 1u);
  // Once more it is not doubled: both of its sides are fronts now.
  const LoadedScene again = loaded(read.scene);
  EXPECT_EQ(again.scene.meshes[0].positions, read.scene.meshes[0].positions);
  EXPECT_EQ(again.scene.meshes[0].triangles, read.scene.meshes[0].triangles);
  EXPECT_TRUE(scene::hasBacks(again.scene.meshes[0]));
  EXPECT_EQ(countOf(again.findings, "two-sided"), 0u);
}

TEST_F(TwoSides, WhatBoundsABodyIsNot) {
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(1, 1), twoSided());
  // A body of two materials: each of its meshes is open, and together they are not.
  scene::addTo(scene, hood(), twoSided());
  scene::addTo(scene, lid(), twoSided());
  const LoadedScene read = loaded(scene);
  for (const scene::Mesh& mesh : read.scene.meshes) EXPECT_FALSE(scene::hasBacks(mesh));
  for (const scene::Material& material : read.scene.materials) EXPECT_TRUE(material.doubleSided);
  EXPECT_EQ(countOf(read.findings, "two-sided"), 0u);
  // Without its floor the box is open. Wound against each other two halves bound nothing.
  scene.meshes.pop_back();
  EXPECT_TRUE(scene::hasBacks(loaded(scene).scene.meshes[1]));
  scene::addTo(scene, scene::flipped(lid()), twoSided());
  EXPECT_TRUE(scene::hasBacks(loaded(scene).scene.meshes[1]));
}

TEST_F(TwoSides, OnesOwnWishGoesBeforeWhatTheFileSays) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(1, 1, 2, 2), twoSided());
  scene::addTo(scene, scene::icosphere(1, 1), {});
  const LoadedScene one = loaded(scene, Sides::One);
  EXPECT_FALSE(scene::hasBacks(one.scene.meshes[0]));
  EXPECT_TRUE(one.scene.materials[0].doubleSided);
  EXPECT_EQ(countOf(one.findings, "one-sided"), 1u);
  const LoadedScene two = loaded(scene, Sides::Two);
  EXPECT_TRUE(scene::hasBacks(two.scene.meshes[0]));
  EXPECT_TRUE(scene::hasBacks(two.scene.meshes[1]));
  EXPECT_EQ(countOf(two.findings, "two-sided"), 2u);
}

TEST_F(TwoSides, FilesOfOtherKindsAreTwoSidedIfOneWishes) {
  LoadOptions options;
  options.sides = Sides::Two;
  const auto obj = load(folder_.write("leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), options);
  ASSERT_TRUE(obj);
  EXPECT_TRUE(scene::hasBacks(obj->scene.meshes[0]));
  const auto ply = load(folder_.write("leaf.ply",
                                      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                      "property float y\nproperty float z\nelement face 1\n"
                                      "property list uchar int vertex_indices\nend_header\n"
                                      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                        options);
  ASSERT_TRUE(ply);
  EXPECT_TRUE(scene::hasBacks(ply->scene.meshes[0]));
}

TEST_F(TwoSides, TheBudgetIsAskedForBacks) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(1, 1, 300, 300), twoSided());
  const auto path = folder_ / "large.glb";
  ASSERT_TRUE(saveGlb(scene, path));
  LoadOptions options;
  options.memoryLimit = std::filesystem::file_size(path) + (std::uint64_t(12) << 20);
  options.sides = Sides::One;
  EXPECT_TRUE(load(path, options));
  std::uint64_t least = *options.memoryLimit;
  while (load(path, options)) options.memoryLimit = least -= 1u << 20;
  options.memoryLimit = least + (1u << 20);
  options.sides = Sides::AsFileSays;
  const auto refused = load(path, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("the back of"), std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace lambent::scene_io
