#include "lambent/scene/diagnose.h"

#include <gtest/gtest.h>

#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

TEST(Topology, HolesAreFound) {
  Mesh mesh = icosphere(1.0f, 1);
  mesh.triangles.pop_back();
  const Topology t = topology(mesh);
  EXPECT_EQ(t.boundaryEdges, 3u);
  EXPECT_FALSE(t.closed());
  EXPECT_FALSE(t.insideOut());
}

TEST(Topology, WindingAgainstItsNeighboursIsFound) {
  Mesh mesh = icosphere(1.0f, 1);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_EQ(topology(mesh).inconsistentEdges, 3u);
}

TEST(Topology, FinsAreFound) {
  Mesh mesh = icosphere(1.0f, 0);
  mesh.positions.push_back(Vec3(9, 9, 9));
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 12});
  const Topology t = topology(mesh);
  EXPECT_EQ(t.nonManifoldEdges, 1u);
  EXPECT_EQ(t.boundaryEdges, 2u);
}

TEST(Topology, InsideOutIsFoundFarFromTheOrigin) {
  EXPECT_FALSE(topology(translated(icosphere(1, 1), Vec3(100, 200, 300))).insideOut());
  EXPECT_TRUE(topology(translated(flipped(icosphere(1, 1)), Vec3(100, 200, 300))).insideOut());
  EXPECT_FALSE(topology(Mesh()).insideOut());
}

TEST(UvCheck, SeparateChartsPass) {
  for (int size : {16, 64, 256, 255}) {
    EXPECT_TRUE(checkUvs(box(Vec3(1, 1, 1), 5), size, size));
    EXPECT_TRUE(checkUvs(uvSphere(1, 37, 23), size, size / 2));
    EXPECT_TRUE(checkUvs(gridPlane(1, 1, 33, 47), size, size));
    EXPECT_TRUE(checkUvs(ring(1, 2, 1, 50), size, size));
  }
}

TEST(UvCheck, CentresOnCommonEdgesAreCovered) {
  // As many texels as cells: all centres lie on diagonals; half as many, on corners of cells.
  for (const int size : {8, 4, 2, 1}) EXPECT_TRUE(checkUvs(gridPlane(1, 1, 8, 8), size, size));
  EXPECT_TRUE(checkUvs(uvSphere(1, 64, 32), 64, 32));
  EXPECT_TRUE(checkUvs(uvSphere(1, 64, 32), 16, 8));
}

TEST(UvCheck, AMirroredChartIsNoOverlapByItself) {
  Mesh mesh = gridPlane(1, 1, 3, 3);
  for (Vec2& uv : mesh.uvs) uv.x() = 1.0f - uv.x();
  EXPECT_TRUE(checkUvs(mesh, 64, 64));
}

TEST(UvCheck, OverlapNamesTrianglesAndTexels) {
  Mesh mesh = gridPlane(1, 1, 1, 1);
  mesh.name = "floor";
  for (Vec2& uv : mesh.uvs) uv = 0.5f * uv;
  const Mesh parts[] = {mesh, translated(mesh, Vec3(3, 0, 0))};
  const Status status = checkUvs(merge(parts), 32, 32);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::BadInput);
  const std::string& message = status.error().message;
  EXPECT_NE(message.find("floor"), std::string::npos) << message;
  EXPECT_NE(message.find("overlap in 240 texels"), std::string::npos) << message;  // 16² − diagonal
  EXPECT_NE(message.find("triangles 0 and 2"), std::string::npos) << message;
}

TEST(UvCheck, MissingOutsideAndEmptyAreErrors) {
  Mesh mesh = gridPlane(1, 1, 1, 1);
  mesh.uvs.clear();
  EXPECT_NE(checkUvs(mesh, 8, 8).error().message.find("no texture coordinates"), std::string::npos);
  mesh = gridPlane(1, 1, 1, 1);
  mesh.uvs[2].x() = 1.5f;
  EXPECT_NE(checkUvs(mesh, 8, 8).error().message.find("vertex 2"), std::string::npos);
  mesh.uvs[2].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(checkUvs(mesh, 8, 8));
  mesh.uvs.assign(4, Vec2(0.5f, 0.5f));
  EXPECT_NE(checkUvs(mesh, 8, 8).error().message.find("cover no texel"), std::string::npos);
}

}  // namespace
}  // namespace lambent::scene
