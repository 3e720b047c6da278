#include <gtest/gtest.h>

#include <cmath>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/weld.h"

namespace lambent::scene {
namespace {

/// `mesh` with one vertex for each place, and no normals.
Mesh weldedFor(const Mesh& mesh) {
  const std::vector<std::uint32_t> places = weldPositions(mesh);
  Mesh result;
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (places[v] == result.positions.size()) result.positions.push_back(mesh.positions[v]);
  }
  for (const Triangle& t : mesh.triangles) {
    result.triangles.push_back({places[t[0]], places[t[1]], places[t[2]]});
  }
  return result;
}

double largestBend(const Mesh& mesh) {
  double worst = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]];
    const Vec3 n = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).normalized();
    for (std::uint32_t v : t) worst = std::max(worst, double((mesh.normals[v] - n).norm()));
  }
  return worst;
}

TEST(Creases, ACubeOfEightVerticesHasSixFaces) {
  Mesh cube = weldedFor(box(Vec3::Ones()));
  ASSERT_EQ(cube.positions.size(), 8u);
  EXPECT_EQ(creaseNormals(cube, 0.0f), 0u);
  EXPECT_EQ(cube.positions.size(), 24u);
  EXPECT_LT(largestBend(cube), 1e-6);
  EXPECT_TRUE(topology(cube).closed());
}

TEST(Creases, AnAngleAboveTheEdgesIsSmoothEverywhere) {
  Mesh cube = weldedFor(box(Vec3::Ones())), smooth = cube;
  creaseNormals(cube, 1.6f);  // above 90°
  computeNormals(smooth);
  ASSERT_EQ(cube.positions.size(), 8u);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_TRUE(cube.normals[v].isApprox(smooth.normals[v]));
}

TEST(Creases, ACylinderKeepsItsRimAndRoundsItsWall) {
  Mesh wall = weldedFor(cylinder(1.0f, 2.0f, 32, 2));
  creaseNormals(wall, 0.5f);
  std::size_t flat = 0;
  for (std::size_t v = 0; v < wall.positions.size(); ++v) {
    const Vec3 &p = wall.positions[v], &n = wall.normals[v];
    if (std::abs(n.y()) > 0.5f) {
      EXPECT_NEAR(std::abs(n.y()), 1.0f, 1e-5f);
      ++flat;
    } else {
      EXPECT_TRUE(n.isApprox(Vec3(p.x(), 0.0f, p.z()).normalized(), 1e-3f)) << n.transpose();
    }
  }
  EXPECT_GE(flat, 64u);
}

TEST(Creases, SeamsOfTexturesAreSmoothAndAttributesGoAlong) {
  Mesh sphere = uvSphere(1.0f, 16, 8);
  const std::size_t before = sphere.positions.size();
  sphere.normals.clear();
  for (const Vec3& p : sphere.positions) sphere.colors.push_back(p.array().abs());
  Mesh facets = sphere;
  creaseNormals(sphere, 1.0f);
  EXPECT_EQ(sphere.positions.size(), before);
  for (std::size_t v = 0; v < before; ++v) {
    EXPECT_GT(sphere.normals[v].dot(sphere.positions[v]), 0.99f);
  }
  creaseNormals(facets, 0.0f);
  EXPECT_LT(largestBend(facets), 1e-3);
  ASSERT_EQ(facets.uvs.size(), facets.positions.size());
  ASSERT_EQ(facets.colors.size(), facets.positions.size());
  for (std::size_t v = 0; v < facets.positions.size(); ++v) {
    EXPECT_TRUE((facets.colors[v] == facets.positions[v].array().abs()).all());
  }
}

TEST(Creases, FinsAndTrianglesWithoutAreaDoNoHarm) {
  Mesh mesh = icosphere(1.0f, 0);
  mesh.normals.clear();
  mesh.positions.push_back(Vec3(9, 9, 9));
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], 12});
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][0], 12});
  mesh.positions.push_back(Vec3(5, 5, 5));  // of no triangle
  EXPECT_GE(creaseNormals(mesh, 0.0f), 1u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(n.norm(), 1.0f, 1e-5f);
}

}  // namespace
}  // namespace lambent::scene
