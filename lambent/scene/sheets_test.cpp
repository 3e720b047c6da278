#include "lambent/scene/sheets.h"

#include <gtest/gtest.h>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

TEST(Sheets, ABackIsTheFrontTurnedOverInTheSamePlace) {
  Mesh front = gridPlane(2, 1, 3, 2);
  front.colors.assign(front.positions.size(), Rgb(0.1f, 0.2f, 0.3f));
  const Mesh mesh = withBacks(front);
  const std::size_t vertices = front.positions.size(), triangles = front.triangles.size();
  ASSERT_EQ(mesh.positions.size(), 2 * vertices);
  ASSERT_EQ(mesh.triangles.size(), 2 * triangles);
  for (std::size_t v = 0; v < vertices; ++v) {
    EXPECT_EQ(mesh.positions[v + vertices], front.positions[v]);
    EXPECT_EQ(mesh.normals[v + vertices], Vec3(-front.normals[v]));
    EXPECT_EQ(mesh.uvs[v + vertices], front.uvs[v]);
    EXPECT_TRUE((mesh.colors[v + vertices] == front.colors[v]).all());
  }
  const Scene scene = sceneOf(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t other = otherSideOf(mesh, t);
    EXPECT_EQ(otherSideOf(mesh, other), t);
    const SurfacePoint here = surfaceAt(scene, 0, t, 0.2f, 0.5f),
                       there = surfaceAt(scene, 0, other, 0.5f, 0.2f);
    EXPECT_TRUE(here.position.isApprox(there.position, 1e-6f));
    EXPECT_TRUE(here.normal.isApprox(Vec3(-there.normal)));
    EXPECT_TRUE(here.geometricNormal.isApprox(Vec3(-there.geometricNormal)));
  }
}

TEST(Sheets, TransformsKeepThemAndNothingElseIsTakenForThem) {
  const Mesh mesh = withBacks(bowl(1, 0.3f, 8, 4));
  EXPECT_TRUE(hasBacks(mesh));
  EXPECT_TRUE(hasBacks(rotated(scaled(mesh, Vec3(-1, 2, 3)), Vec3(1, 2, 3), 0.7f)));
  EXPECT_FALSE(hasBacks(Mesh()));
  EXPECT_FALSE(hasBacks(gridPlane(1, 1, 2, 2)));
  EXPECT_FALSE(hasBacks(box(Vec3(1, 1, 1))));
  EXPECT_FALSE(hasBacks(withBacks(Mesh())));
  Mesh moved = mesh;
  moved.positions.back().x() += 1e-3f;
  EXPECT_FALSE(hasBacks(moved));
  Mesh turned = mesh;
  std::swap(turned.triangles.back()[1], turned.triangles.back()[2]);
  EXPECT_FALSE(hasBacks(turned));
  Mesh shared = mesh;  // the back's triangle on the front's vertices
  for (std::uint32_t& corner : shared.triangles.back())
    corner -= std::uint32_t(mesh.positions.size() / 2);
  EXPECT_FALSE(hasBacks(shared));
}

TEST(Sheets, BacksHaveTexelsOfTheirOwn) {
  Mesh mesh = withBacks(gridPlane(1, 1, 4, 4));
  EXPECT_FALSE(checkUvs(mesh, 32, 32));
  layOutBacks(mesh);
  EXPECT_TRUE(hasBacks(mesh));
  EXPECT_TRUE(checkUvs(mesh, 64, 32));
}

}  // namespace
}  // namespace lambent::scene
