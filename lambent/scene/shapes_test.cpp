#include "lambent/scene/shapes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/scene/diagnose.h"

namespace lambent::scene {
namespace {

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p = mesh.positions[a].cast<double>();
    sum +=
        0.5 *
        (mesh.positions[b].cast<double>() - p).cross(mesh.positions[c].cast<double>() - p).norm();
  }
  return sum;
}

/// Unit normals on the front of every triangle, no triangle without area, no vertex without one.
void expectSound(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(n.norm(), 1.0f, 1e-5f);
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::uint32_t i : t) {
      ASSERT_LT(i, mesh.positions.size());
      used[i] = true;
    }
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 cross = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
    ASSERT_GT(cross.norm(), 0.0f) << mesh.name;
    for (std::uint32_t i : t) ASSERT_GT(cross.normalized().dot(mesh.normals[i]), 0.0f) << mesh.name;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << mesh.name;
}

void expectClosed(const Mesh& mesh, double volume, double tolerance) {
  expectSound(mesh);
  const Topology t = topology(mesh);
  EXPECT_EQ(t.boundaryEdges, 0u) << mesh.name;
  EXPECT_EQ(t.nonManifoldEdges, 0u) << mesh.name;
  EXPECT_TRUE(t.consistent()) << mesh.name;
  EXPECT_NEAR(t.signedVolume, volume, tolerance * std::abs(volume)) << mesh.name;
}

TEST(Shapes, ClosedOnesAreClosedAndHoldTheirVolume) {
  expectClosed(uvSphere(2.0f, 96, 48), 4.0 / 3.0 * kPi * 8.0, 0.01);
  expectClosed(icosphere(2.0f, 4), 4.0 / 3.0 * kPi * 8.0, 0.01);
  expectClosed(box(Vec3(1, 2, 3), 4), 6.0, 1e-6);
  expectClosed(room(Vec3(1, 2, 3)), -6.0, 1e-6);
  expectClosed(cylinder(0.5f, 3.0f, 128, 3), kPi * 0.25 * 3.0, 0.01);
  expectClosed(torus(2.0f, 0.5f, 96, 48), 2.0 * kPi * kPi * 2.0 * 0.25, 0.01);
  expectClosed(ring(0.9f, 1.0f, 0.5f, 128, 3), kPi * 0.19 * 0.5, 0.01);
}

TEST(Shapes, EulerCharacteristics) {
  const auto euler = [](const Mesh& m) {
    const Topology t = topology(m);
    return long(t.vertices) - long(t.edges) + long(m.triangles.size());
  };
  EXPECT_EQ(euler(uvSphere(1, 12, 7)), 2);
  EXPECT_EQ(euler(icosphere(1, 2)), 2);
  EXPECT_EQ(euler(box(Vec3(1, 1, 1), 3)), 2);
  EXPECT_EQ(euler(cylinder(1, 1, 9)), 2);
  EXPECT_EQ(euler(torus(2, 1, 12, 9)), 0);
  EXPECT_EQ(euler(ring(1, 2, 1, 12)), 0);
  EXPECT_EQ(icosphere(1, 3).positions.size(), 642u);
}

TEST(Shapes, BowlCoversItsFractionAndFacesItsCentre) {
  for (float s : {0.25f, 0.5f, 0.9f}) {
    const Mesh mesh = bowl(2.0f, s, 128, 64);
    expectSound(mesh);
    EXPECT_NEAR(area(mesh), s * 16.0 * kPi, 0.005 * 16.0 * kPi);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_TRUE((mesh.positions[i] + 2.0f * mesh.normals[i]).isZero(1e-5f));
    }
    EXPECT_GT(topology(mesh).boundaryEdges, 0u);
  }
  EXPECT_TRUE(topology(bowl(1.0f, 1.0f, 16, 8)).insideOut());
}

TEST(Shapes, PlaneHasUvsOverTheSquare) {
  const Mesh mesh = gridPlane(2.0f, 4.0f, 3, 5);
  expectSound(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.triangles.size(), 30u);
  EXPECT_NEAR(area(mesh), 8.0, 1e-6);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.positions[i].x(), (mesh.uvs[i].x() - 0.5f) * 2.0f, 1e-6f);
    EXPECT_NEAR(mesh.positions[i].z(), (mesh.uvs[i].y() - 0.5f) * 4.0f, 1e-6f);
    EXPECT_TRUE(mesh.normals[i].isApprox(Vec3::UnitY()));
  }
  EXPECT_TRUE(checkUvs(mesh, 256, 256));
}

TEST(Shapes, TransformsKeepTheFrontInFront) {
  const Mesh sphere = icosphere(1.0f, 2);
  expectClosed(scaled(sphere, Vec3(-2, 1, 1)), 2 * topology(sphere).signedVolume, 1e-4);
  expectClosed(scaled(sphere, Vec3(-1, -1, -1)), topology(sphere).signedVolume, 1e-4);
  expectClosed(rotated(translated(sphere, Vec3(5, 0, 0)), Vec3(1, 1, 0), 2.0f),
               topology(sphere).signedVolume, 1e-4);
  // Normals of an ellipsoid are its gradient's: (x/a², y/b², z/c²).
  const Mesh ellipsoid = scaled(sphere, Vec3(3, 1, 2));
  for (std::size_t i = 0; i < ellipsoid.positions.size(); ++i) {
    const Vec3 p = ellipsoid.positions[i];
    const Vec3 gradient = Vec3(p.x() / 9, p.y(), p.z() / 4).normalized();
    EXPECT_TRUE(ellipsoid.normals[i].isApprox(gradient, 1e-4f));
  }
}

TEST(Shapes, MergedMeshesKeepTheirParts) {
  const Mesh parts[] = {icosphere(1.0f, 1), translated(box(Vec3(1, 1, 1)), Vec3(4, 0, 0))};
  const Mesh whole = merge(parts);
  EXPECT_EQ(whole.positions.size(), parts[0].positions.size() + 24);
  EXPECT_TRUE(whole.uvs.empty());  // the icosphere has none
  EXPECT_NEAR(topology(whole).signedVolume, topology(parts[0]).signedVolume + 1.0, 1e-5);
  expectSound(whole);
}

TEST(Shapes, ComputedNormalsAreTheSpheres) {
  Mesh mesh = icosphere(3.0f, 4);
  const std::vector<Vec3> exact = mesh.normals;
  EXPECT_EQ(computeNormals(mesh), 0u);
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_GT(mesh.normals[i].dot(exact[i]), 0.9999f);
}

TEST(Shapes, ComputedNormalsDoNotSeeHowAQuadWasCut) {
  Mesh cube;
  for (int i = 0; i < 8; ++i) cube.positions.push_back(Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  EXPECT_EQ(computeNormals(cube), 0u);
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = (cube.positions[i] - Vec3::Constant(0.5f)).normalized();
    EXPECT_TRUE(cube.normals[i].isApprox(corner, 1e-5f));
  }
}

TEST(Shapes, ComputedNormalsOfAFoldedSheetAreOneOfItsSides) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(computeNormals(mesh), 0u);
  for (const Vec3& n : mesh.normals) EXPECT_TRUE(n.isApprox(Vec3::UnitZ()));
}

TEST(Shapes, ComputedNormalsGuardDegenerateTrianglesAndShareGroups) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 3, 0}};
  EXPECT_EQ(computeNormals(mesh), 2u);
  EXPECT_TRUE(mesh.normals[0].isApprox(Vec3::UnitZ()));
  EXPECT_TRUE(mesh.normals[3].isApprox(Vec3::UnitY()));
  const std::vector<std::uint32_t> groups = {0, 1, 2, 3, 0};
  EXPECT_EQ(computeNormals(mesh, groups), 1u);
  EXPECT_TRUE(mesh.normals[4].isApprox(Vec3::UnitZ()));
}

}  // namespace
}  // namespace lambent::scene
