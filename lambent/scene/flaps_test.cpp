#include "lambent/scene/flaps.h"

#include <gtest/gtest.h>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

/// A further vertex beside an edge of the mesh's first triangle, and a triangle back to back there.
void addFlap(Mesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const auto tip = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]) + 0.1f * mesh.normals[a]);
  mesh.normals.push_back(mesh.normals[a]);
  mesh.triangles.push_back({a, b, tip});
  mesh.triangles.push_back({b, a, tip});
}

TEST(Flaps, WhatHangsOnASurfaceGoesAndTheSurfaceIsWhole) {
  const Mesh sphere = icosphere(1.0f, 2);
  Mesh mesh = sphere;
  mesh.uvs.clear();
  for (const std::uint32_t t : {3u, 50u, 200u}) addFlap(mesh, t);
  // And one that lies on a triangle of the surface itself.
  const auto [a, b, c] = mesh.triangles[120];
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({b, a, c});
  ASSERT_GT(topology(mesh).nonManifoldEdges, 0u);
  EXPECT_EQ(dropFlaps(mesh), 4u);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(mesh.triangles.size(), sphere.triangles.size());
  EXPECT_EQ(mesh.positions.size(), sphere.positions.size());
  EXPECT_NEAR(topology(mesh).signedVolume, topology(sphere).signedVolume, 1e-6);
  EXPECT_EQ(dropFlaps(mesh), 0u);
}

TEST(Flaps, LeavesStay) {
  // A leaf of two triangles, back to back, by itself…
  Mesh leaf = gridPlane(1.0f, 1.0f, 1, 1);
  const std::vector<Triangle> front = leaf.triangles;
  for (const auto& [a, b, c] : front) leaf.triangles.push_back({a, c, b});
  EXPECT_EQ(dropFlaps(leaf), 0u);
  EXPECT_EQ(leaf.triangles.size(), 4u);
  // … and a fin of four that hangs on a sphere.
  Mesh fish = icosphere(1.0f, 2);
  fish.uvs.clear();
  addFlap(fish, 3);
  for (int k = 0; k < 3; ++k) {
    const auto tip = std::uint32_t(fish.positions.size());
    const std::uint32_t a = tip - 1, b = fish.triangles[3][0];
    fish.positions.push_back(fish.positions[a] + Vec3(0.05f, 0.1f, 0.02f * float(k)));
    fish.normals.push_back(fish.normals[a]);
    fish.triangles.push_back({b, a, tip});
    fish.triangles.push_back({a, b, tip});
  }
  const std::size_t count = fish.triangles.size();
  EXPECT_EQ(dropFlaps(fish), 0u);
  EXPECT_EQ(fish.triangles.size(), count);
}

TEST(Flaps, ClosedSurfacesAndSheetsWithBacksHaveNone) {
  Mesh sphere = icosphere(1.0f, 2);
  EXPECT_EQ(dropFlaps(sphere), 0u);
  Mesh empty;
  EXPECT_EQ(dropFlaps(empty), 0u);
}

}  // namespace
}  // namespace lambent::scene
