// Triangles cut where shadows fall: what is cut, what is left alone, and what it gains.
#include "lambent/macro/refine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/interpolation_error.h"
#include "lambent/macro/test_bake.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"

namespace lambent::macro {
namespace {

/// A box of hard edges on a floor of two triangles.
scene::Scene coarseFloor() {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(6, 6, 1, 1), painted(Rgb::Constant(0.7f)));
  scene::addTo(scene, scene::translated(scene::box(Vec3(1, 1, 1), 1), Vec3(0.3f, 0.5f, -0.2f)),
               painted(Rgb::Constant(0.5f)));
  return scene;
}

Result<Refined> refined(const scene::Scene& scene, const RefineOptions& options = {},
                        const Placement& placement = {}) {
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, placement, rays->offset());
  EXPECT_TRUE(receivers);
  return refine(scene, *rays, *receivers, options, {});
}

double rmsOf(const scene::Scene& scene) {
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  InterpolationErrorOptions options;
  options.seed = 99;  // not where refine looked
  return (*interpolationError(scene, *rays, *receivers, options, {}))->rms;
}

void expectSameMeshes(const scene::Scene& a, const scene::Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].positions, b.meshes[m].positions);
    EXPECT_EQ(a.meshes[m].normals, b.meshes[m].normals);
    EXPECT_EQ(a.meshes[m].uvs, b.meshes[m].uvs);
    EXPECT_EQ(a.meshes[m].triangles, b.meshes[m].triangles);
  }
}

TEST(Refine, AFloorOfTwoTrianglesHoldsTheShadowOfABox) {
  const scene::Scene scene = coarseFloor();
  const auto fine = refined(scene);
  ASSERT_TRUE(fine);
  EXPECT_FALSE(fine->spent);
  EXPECT_LT(rmsOf(fine->scene), 0.15 * rmsOf(scene));
  std::size_t vertices = 0;
  for (const scene::Mesh& mesh : fine->scene.meshes) vertices += mesh.positions.size();
  EXPECT_EQ(vertices, 28 + fine->added);
  // An even grid as fine as that beside the box has many times as many.
  const scene::Mesh& floor = fine->scene.meshes[0];
  float shortest = 6.0f;
  for (const scene::Triangle& t : floor.triangles)
    shortest = std::min(shortest, (floor.positions[t[0]] - floor.positions[t[1]]).norm());
  EXPECT_LT(5.0 * double(floor.positions.size()), 36.0 / (shortest * shortest));
}

TEST(Refine, ThereAreNoCracks) {
  const auto fine = refined(coarseFloor());
  ASSERT_TRUE(fine);
  const scene::Topology box = scene::topology(fine->scene.meshes[1]);
  EXPECT_TRUE(box.closed());
  EXPECT_TRUE(box.consistent());
  EXPECT_NEAR(box.signedVolume, 1.0, 1e-5);
  // The border of the floor is its four sides, and nothing inside of it is open.
  const scene::Topology floor = scene::topology(fine->scene.meshes[0]);
  EXPECT_EQ(floor.nonManifoldEdges, 0u);
  std::size_t onBorder = 0;
  for (const Vec3& p : fine->scene.meshes[0].positions)
    onBorder += std::abs(p.x()) == 3.0f || std::abs(p.z()) == 3.0f ? 1 : 0;
  EXPECT_EQ(floor.boundaryEdges, onBorder);
}

TEST(Refine, LeavesAloneWhatHasNoShadows) {
  for (const scene::Mesh& mesh : {scene::gridPlane(6, 6, 1, 1), scene::box(Vec3(1, 2, 3))}) {
    const scene::Scene scene = scene::sceneOf(mesh);
    const auto same = refined(scene);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->added, 0u);
    expectSameMeshes(same->scene, scene);
  }
}

TEST(Refine, IsTheSameAtAnyThreadCount) {
  RefineOptions options;
  options.threads = 1;
  const auto one = refined(coarseFloor(), options);
  options.threads = 4;
  const auto four = refined(coarseFloor(), options);
  ASSERT_TRUE(one && four);
  expectSameMeshes(one->scene, four->scene);
}

TEST(Refine, KeepsTheBudget) {
  for (const std::size_t budget : {0, 1, 50, 150}) {
    RefineOptions options;
    options.budget = budget;
    const auto fine = refined(coarseFloor(), options);
    ASSERT_TRUE(fine);
    EXPECT_TRUE(fine->spent);
    EXPECT_LE(fine->added, budget);
    EXPECT_GE(fine->added + 12, budget);
  }
}

TEST(Refine, MoreErrorTakesFewerVertices) {
  RefineOptions rough;
  RefineOptions exact;
  rough.error = 0.05, exact.error = 0.01;
  const auto few = refined(coarseFloor(), rough), many = refined(coarseFloor(), exact);
  ASSERT_TRUE(few && many);
  EXPECT_GT(few->added, 20u);
  EXPECT_LT(2 * few->added, many->added);
}

TEST(Refine, MeshesOfTexelsAreLeftAlone) {
  const scene::Scene scene = coarseFloor();
  const auto fine = refined(scene, {}, {{{0, 32, 32}}, {}});
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->scene.meshes[0].positions, scene.meshes[0].positions);
}

// The floor under a box that stands in it is no shadow: nobody sees it.
TEST(Refine, DoesNotChaseWhatIsBuried) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(2, 2, 8, 8), painted(Rgb::Constant(0.7f)));
  scene::addTo(scene, scene::translated(scene::box(Vec3(3, 2, 3), 4), Vec3(0, 0.3f, 0)),
               painted(Rgb::Constant(0.5f)));
  const auto same = refined(scene);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->added, 0u);
}

TEST(Refine, TrianglesWithoutAreaDoNoHarm) {
  scene::Scene scene = coarseFloor();
  scene::Mesh& floor = scene.meshes[0];
  floor.triangles.push_back({0, 1, 1});
  floor.triangles.push_back({0, 0, 0});
  floor.positions.push_back(0.5f * (floor.positions[0] + floor.positions[1]));
  floor.normals.push_back(Vec3::UnitY());
  floor.uvs.push_back(0.5f * (floor.uvs[0] + floor.uvs[1]));
  floor.triangles.push_back({0, 1, 4});
  const auto fine = refined(scene);
  ASSERT_TRUE(fine);
  EXPECT_GT(fine->added, 100u);
  for (const Vec3& p : fine->scene.meshes[0].positions) EXPECT_TRUE(p.allFinite());
}

TEST(Refine, RefusesWhatMakesNoSense) {
  for (const double error : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    RefineOptions options;
    options.error = error;
    const auto fine = refined(coarseFloor(), options);
    ASSERT_FALSE(fine);
    EXPECT_EQ(fine.error().kind, ErrorKind::BadUsage);
  }
}

TEST(Refine, CanBeCancelled) {
  const scene::Scene scene = coarseFloor();
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  const auto fine =
      refine(scene, *rays, *receivers, {}, [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(fine);
  EXPECT_EQ(fine.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::macro
