#include "lambent/scene/split_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"

namespace lambent::scene {
namespace {

/// Marks a third of the edges, drawn at random, and closes.
std::vector<std::uint8_t> someMarks(const SceneEdges& edges, std::uint64_t seed) {
  std::vector<std::uint8_t> marks(edges.size(), 0);
  for (std::size_t e = 0; e < marks.size(); ++e)
    marks[e] = math::Random(seed, e).uniform() < 0.33f ? 1 : 0;
  closeMarks(edges, marks);
  return marks;
}

Scene cutAtRandom(Scene scene, int times) {
  for (int k = 0; k < times; ++k) {
    const SceneEdges edges = edgesOf(scene);
    scene = splitEdges(scene, edges, someMarks(edges, std::uint64_t(k))).scene;
  }
  return scene;
}

Vec3d crossOf(const Mesh& mesh, const Triangle& t) {
  const Vec3d a = mesh.positions[t[0]].cast<double>();
  return (mesh.positions[t[1]].cast<double>() - a).cross(mesh.positions[t[2]].cast<double>() - a);
}

double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * crossOf(mesh, t).norm();
  return area;
}

double smallestAngle(const Mesh& mesh) {
  double smallest = kPi;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = mesh.positions[t[k]].cast<double>();
      const Vec3d a = mesh.positions[t[(k + 1) % 3]].cast<double>() - at;
      const Vec3d b = mesh.positions[t[(k + 2) % 3]].cast<double>() - at;
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  return smallest;
}

TEST(SplitEdges, OneMarkCutsTwoTriangles) {
  const Scene plane = sceneOf(gridPlane(2, 2, 1, 1));
  const SceneEdges edges = edgesOf(plane);
  ASSERT_EQ(edges.size(), 5u);
  std::vector<std::uint8_t> marks(5, 0);
  for (std::uint32_t e = 0; e < 5; ++e)
    if (edges.usersOf(e).size() == 2) marks[e] = 1;  // the diagonal
  closeMarks(edges, marks);
  EXPECT_EQ(addedVertices(plane, edges, marks), 1u);
  const SplitScene split = splitEdges(plane, edges, marks);
  const Mesh& mesh = split.scene.meshes[0];
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.positions[4], Vec3(0, 0, 0));
  EXPECT_EQ(mesh.uvs[4], Vec2(0.5f, 0.5f));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(split.parentOf[0], (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

TEST(SplitEdges, AShortEdgeTakesTheLongestAlong) {
  const Scene plane = sceneOf(gridPlane(2, 2, 1, 1));
  const SceneEdges edges = edgesOf(plane);
  std::vector<std::uint8_t> marks(5, 0);
  for (std::uint32_t e = 0; e < 5; ++e)
    if (edges.usersOf(e).size() == 1) {
      marks[e] = 1;
      break;
    }
  closeMarks(edges, marks);
  const SplitScene split = splitEdges(plane, edges, marks);
  EXPECT_EQ(split.scene.meshes[0].triangles.size(), 5u);  // one of them in three, one in two
  EXPECT_EQ(addedVertices(plane, edges, marks), 2u);
}

TEST(SplitEdges, NothingMarkedIsTheSameScene) {
  const Scene scene = sceneOf(box(Vec3(1, 2, 3), 2));
  const SceneEdges edges = edgesOf(scene);
  const Mesh after =
      splitEdges(scene, edges, std::vector<std::uint8_t>(edges.size(), 0)).scene.meshes[0];
  EXPECT_EQ(after.triangles, scene.meshes[0].triangles);
  EXPECT_EQ(after.positions, scene.meshes[0].positions);
}

// A box is flat-shaded: its faces share positions and no vertices.
TEST(SplitEdges, AClosedBodyOfHardEdgesStaysClosed) {
  Scene scene;
  addTo(scene, box(Vec3(1, 2, 3), 1), {});
  addTo(scene, torus(1, 0.3f, 9, 7), {});
  const Scene after = cutAtRandom(scene, 5);
  for (std::size_t m = 0; m < 2; ++m) {
    const Topology before = topology(scene.meshes[m]), now = topology(after.meshes[m]);
    EXPECT_GT(now.vertices, 4 * before.vertices);
    EXPECT_TRUE(now.closed());
    EXPECT_TRUE(now.consistent());
    EXPECT_NEAR(now.signedVolume, before.signedVolume, 1e-5 * before.signedVolume);
    EXPECT_NEAR(areaOf(after.meshes[m]), areaOf(scene.meshes[m]), 1e-5 * areaOf(scene.meshes[m]));
  }
}

// Two meshes that meet in a row of edges: no edge of either runs past a vertex of the other.
TEST(SplitEdges, MeshesThatShareEdgesAreCutAtTheSamePlaces) {
  Scene scene;
  const Mesh left = gridPlane(2, 2, 2, 2);
  addTo(scene, left, {});
  addTo(scene, translated(left, Vec3(2, 0, 0)), {});
  const Scene after = cutAtRandom(scene, 6);
  using Place = std::tuple<float, float, float>;
  std::set<Place> seam[2];
  for (std::size_t m = 0; m < 2; ++m)
    for (const Vec3& p : after.meshes[m].positions)
      if (p.x() == 1.0f) seam[m].insert({p.x(), p.y(), p.z()});
  EXPECT_EQ(seam[0], seam[1]);
  EXPECT_GT(seam[0].size(), 6u);
}

TEST(SplitEdges, AttributesAreLinearAndTrianglesKeepTheirSide) {
  Mesh mesh = gridPlane(3, 2, 2, 1);
  const auto colorAt = [](const Vec3& p) {
    return Rgb(0.5f + 0.1f * p.x(), 0.3f - 0.1f * p.z(), 0.25f);
  };
  for (const Vec3& p : mesh.positions) mesh.colors.push_back(colorAt(p));
  const Scene after = cutAtRandom(sceneOf(mesh), 5);
  const Mesh& cutMesh = after.meshes[0];
  ASSERT_EQ(cutMesh.uvs.size(), cutMesh.positions.size());
  ASSERT_EQ(cutMesh.colors.size(), cutMesh.positions.size());
  for (std::size_t v = 0; v < cutMesh.positions.size(); ++v) {
    const Vec3& p = cutMesh.positions[v];
    EXPECT_LT((cutMesh.uvs[v] - Vec2(p.x() / 3 + 0.5f, p.z() / 2 + 0.5f)).norm(), 1e-6f);
    EXPECT_LT((cutMesh.colors[v] - colorAt(p)).abs().maxCoeff(), 1e-6f);
    EXPECT_EQ(cutMesh.normals[v], Vec3(0, 1, 0));
  }
  for (const Triangle& t : cutMesh.triangles) EXPECT_GT(crossOf(cutMesh, t).y(), 0.0);
}

TEST(SplitEdges, NormalsStayUnitAndOppositeOnesMakeNoNan) {
  Mesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 0, -1)};
  mesh.normals = {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1, 0, 0)};
  mesh.triangles = {{0, 1, 2}};
  const Scene after = cutAtRandom(sceneOf(mesh), 4);
  for (const Vec3& n : after.meshes[0].normals) EXPECT_NEAR(n.norm(), 1.0f, 1e-5f);
}

TEST(SplitEdges, AnglesStayAboveHalfOfTheSmallest) {
  const Scene scene = sceneOf(transformed(
      icosphere(1, 1), Mat4(Eigen::Vector4f(3, 1, 0.7f, 1).asDiagonal().toDenseMatrix())));
  const double before = smallestAngle(scene.meshes[0]);
  EXPECT_GT(smallestAngle(cutAtRandom(scene, 8).meshes[0]), 0.4 * before);
}

TEST(SplitEdges, TrianglesWithoutAreaAreCutWithTheirNeighbours) {
  Mesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, -1), Vec3(0, 0, 0)};
  mesh.normals.assign(5, Vec3(0, 1, 0));
  mesh.triangles = {{0, 1, 3}, {1, 0, 2}, {0, 4, 4}, {0, 4, 1}};
  const Scene after = cutAtRandom(sceneOf(mesh), 4);
  for (const Vec3& p : after.meshes[0].positions) EXPECT_TRUE(p.allFinite());
  EXPECT_NEAR(areaOf(after.meshes[0]), 1.0, 1e-6);
}

TEST(SplitEdges, BacksStayThoseOfTheirFronts) {
  Scene scene = sceneOf(withBacks(gridPlane(2, 1, 3, 2)));
  scene.meshes[0].alphas.assign(scene.meshes[0].positions.size(), 0.25f);
  for (int round = 0; round < 4; ++round) {
    const SceneEdges edges = edgesOf(scene);
    const std::vector<std::uint8_t> marks = someMarks(edges, std::uint64_t(round));
    const std::size_t before = scene.meshes[0].triangles.size();
    SplitScene split = splitEdges(scene, edges, marks);
    const Mesh& mesh = split.scene.meshes[0];
    ASSERT_GT(mesh.triangles.size(), before);
    EXPECT_TRUE(hasBacks(mesh));
    ASSERT_EQ(split.parentOf[0].size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size() / 2; ++t)
      EXPECT_EQ(split.parentOf[0][t + mesh.triangles.size() / 2],
                split.parentOf[0][t] + before / 2);
    const std::vector<std::uint32_t> other = verticesOfOtherSide(mesh);
    for (std::size_t v = 0; v < other.size(); ++v)
      EXPECT_EQ(mesh.normals[other[v]], Vec3(-mesh.normals[v]));
    ASSERT_EQ(mesh.alphas.size(), mesh.positions.size());
    EXPECT_EQ(mesh.alphas.back(), 0.25f);
    scene = std::move(split.scene);
  }
}

TEST(SplitLongEdges, NoneIsLeftAndTheSurfaceStays) {
  Scene scene = sceneOf(box(Vec3(1, 2, 3), 1));
  const double area = areaOf(scene.meshes[0]);
  const std::size_t before = scene.meshes[0].positions.size();
  const std::vector<std::uint32_t> all = {0};
  const std::size_t added = splitLongEdges(scene, all, 0.3f, 100'000);
  EXPECT_EQ(scene.meshes[0].positions.size(), before + added);
  EXPECT_NEAR(areaOf(scene.meshes[0]), area, 1e-5 * area);
  const SceneEdges edges = edgesOf(scene);
  EXPECT_LE(*std::max_element(edges.lengths.begin(), edges.lengths.end()), 0.3f);
  for (std::uint32_t e = 0; e < edges.size(); ++e) EXPECT_EQ(edges.usersOf(e).size(), 2u);
  EXPECT_EQ(splitLongEdges(scene, all, 0.3f, 100'000), 0u);
}

TEST(SplitLongEdges, ABudgetIsKept) {
  Scene scene = sceneOf(box(Vec3(1, 2, 3), 1));
  const std::vector<std::uint32_t> all = {0};
  const std::size_t added = splitLongEdges(scene, all, 1e-6f, 500);
  EXPECT_LE(added, 500u);
  EXPECT_GT(added, 100u);
}

}  // namespace
}  // namespace lambent::scene
