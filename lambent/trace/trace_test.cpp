#include <gtest/gtest.h>

#include <set>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/scene/sheets.h"
#include "lambent/trace/cast.h"
#include "lambent/trace/veils.h"
#include "lambent/work/flush_denormals.h"

namespace lambent::trace {
namespace {

/// One triangle pair in the plane y = height, facing up or down.
scene::Mesh square(float height, float half, bool up) {
  scene::Mesh mesh;
  mesh.positions = {
      {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
  mesh.normals.assign(4, Vec3(0, up ? 1 : -1, 0));
  mesh.triangles = up ? std::vector<scene::Triangle>{{0, 2, 1}, {0, 3, 2}}
                      : std::vector<scene::Triangle>{{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

scene::Scene floorAndCeiling() {
  scene::Scene scene;
  scene.materials.emplace_back();
  scene.meshes = {square(0, 1, true), square(1, 1, false)};
  return scene;
}

TEST(RayScene, RejectsAnEmptyScene) {
  EXPECT_FALSE(RayScene::build(scene::Scene{}));
}

TEST(RayScene, NamesTheMeshTriangleAndSide) {
  const auto rays = RayScene::build(floorAndCeiling());
  ASSERT_TRUE(rays);
  const auto up = rays->closest({0.5f, 0.5f, 0.2f}, {0, 1, 0});
  ASSERT_TRUE(up);
  EXPECT_EQ(up->mesh, 1u);
  EXPECT_FALSE(up->backFace);
  EXPECT_NEAR(up->distance, 0.5f, 1e-6f);
  const auto behind = rays->closest({0.5f, -1, 0.2f}, {0, 1, 0});
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->mesh, 0u);
  EXPECT_TRUE(behind->backFace);
  EXPECT_FALSE(rays->closest({0.5f, 2, 0.2f}, {0, 1, 0}));
  EXPECT_TRUE(rays->occluded({0.5f, 0.5f, 0.2f}, {0, 1, 0}));
  EXPECT_FALSE(rays->occluded({0.5f, 0.5f, 0.2f}, {0, 1, 0}, 0.0f, 0.4f));
  EXPECT_EQ(rays->locate(3).mesh, 1u);
  EXPECT_EQ(rays->locate(3).triangle, 1u);
}

TEST(RayScene, BarycentricsMeetTheSurfacePoint) {
  const scene::Scene scene = floorAndCeiling();
  const auto rays = RayScene::build(scene);
  ASSERT_TRUE(rays);
  const auto hit = rays->closest({0.3f, 0.5f, -0.7f}, {0, -1, 0});
  ASSERT_TRUE(hit);
  const scene::SurfacePoint point =
      scene::surfaceAt(scene, hit->mesh, hit->triangle, hit->u, hit->v);
  EXPECT_LT((point.position - Vec3(0.3f, 0, -0.7f)).norm(), 1e-6f);
}

TEST(RayScene, OfTwoSidesItNamesTheOneThatIsMet) {
  scene::Scene scene = floorAndCeiling();
  scene.meshes.insert(scene.meshes.begin() + 1, scene::withBacks(square(0.5f, 1, true)));
  const auto rays = RayScene::build(scene);
  ASSERT_TRUE(rays);
  EXPECT_EQ(
      std::vector<std::uint32_t>(rays->triangleOffsets().begin(), rays->triangleOffsets().end()),
      (std::vector<std::uint32_t>{0, 2, 6, 8}));
  for (const float from : {0.1f, 0.9f}) {
    const Vec3 origin(0.3f, from, -0.7f);
    const Vec3 direction(0, from < 0.5f ? 1.0f : -1.0f, 0);
    const auto hit = rays->closest(origin, direction);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mesh, 1u);
    EXPECT_FALSE(hit->backFace);
    EXPECT_EQ(hit->triangle<2, from> 0.5f);
    const scene::SurfacePoint point =
        scene::surfaceAt(scene, hit->mesh, hit->triangle, hit->u, hit->v);
    EXPECT_LT((point.position - Vec3(0.3f, 0.5f, -0.7f)).norm(), 1e-6f);
    EXPECT_LT(point.normal.dot(direction), -0.99f);
    // Past it the ceiling or the floor is met, and not the other side.
    const auto behind = rays->closest(point.position + 1e-4f * direction, direction);
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->mesh, from > 0.5f ? 0u : 2u);
    EXPECT_TRUE(rays->occluded(origin, direction, 0.0f, 0.45f));
  }
  const work::FlushDenormals flush;
  const DirectionSet set(2000, math::randomRotation(1));
  CastResult cast;
  castClosest(*rays, set, Vec3(0.1f, 0.2f, 0), Vec3::UnitY(), cast);
  std::size_t met = 0;
  for (const DirectionHit& hit : cast.hits) {
    const auto place = rays->locate(hit.globalTriangle);
    EXPECT_FALSE(hit.backFace);
    if (place.mesh != 1) continue;
    ++met;
    EXPECT_GE(place.triangle, 2u);
    const scene::SurfacePoint point =
        scene::surfaceAt(scene, place.mesh, place.triangle, hit.u, hit.v);
    const Vec3 expected = Vec3(0.1f, 0.2f, 0) + hit.distance * set[hit.direction];
    EXPECT_LT((point.position - expected).norm(), 1e-5f);
  }
  EXPECT_GT(met, 500u);
}

TEST(DirectionSet, IsEquallyWeightedWithTightBundles) {
  const DirectionSet set(1000, math::randomRotation(3));
  EXPECT_EQ(set.size(), 1000u);
  Vec3d mean = Vec3d::Zero();
  for (std::size_t i = 0; i < set.size(); ++i) {
    EXPECT_NEAR(set[i].norm(), 1.0f, 1e-6f);
    mean += set[i].cast<double>() / 1000.0;
  }
  EXPECT_LT(mean.norm(), 1e-2);
  EXPECT_EQ(set.bundles().size(), 63u);
  for (std::size_t b = 0; b < set.bundles().size(); ++b)
    for (std::size_t i = 16 * b; i < std::min<std::size_t>(16 * b + 16, set.size()); ++i) {
      const auto& bundle = set.bundles()[b];
      const float cosine = bundle.axis.dot(set[i]);
      if (bundle.sinAngle < 1.0f) {
        EXPECT_LE(std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), bundle.sinAngle + 1e-6f);
      }
    }
}

TEST(Cast, TakesJustTheHemisphereAndAgreesWithSingleRays) {
  const auto rays = RayScene::build(floorAndCeiling());
  ASSERT_TRUE(rays);
  const work::FlushDenormals flush;
  CastResult occlusion, closest;
  for (int trial = 0; trial < 20; ++trial) {
    const DirectionSet set(997 + trial, math::randomRotation(trial));
    math::Random random(7, trial, 0);
    const Vec2 u = random.uniform2();
    const Vec3 normal = math::randomRotation(100 + trial) * Vec3(0, 0, 1);
    const Vec3 origin(u.x() - 0.5f, 0.5f, u.y() - 0.5f);
    castOcclusion(*rays, set, origin, normal, occlusion);
    castClosest(*rays, set, origin, normal, closest);
    std::set<std::uint32_t> blocked, met;
    for (const std::uint32_t d : occlusion.occludedDirections()) blocked.insert(d);
    for (const DirectionHit& hit : closest.hits) met.insert(hit.direction);
    std::size_t expectedRays = 0;
    for (std::uint32_t d = 0; d < set.size(); ++d) {
      const bool above =
          set[d].x() * normal.x() + set[d].y() * normal.y() + set[d].z() * normal.z() > 0.0f;
      expectedRays += above;
      EXPECT_EQ(blocked.count(d), above && rays->occluded(origin, set[d]) ? 1u : 0u);
    }
    EXPECT_EQ(occlusion.raysCast, expectedRays);
    EXPECT_EQ(occlusion.occludedCount + occlusion.visibleCount, expectedRays);
    EXPECT_EQ(blocked, met);
    for (const DirectionHit& hit : closest.hits) {
      const auto single = rays->closest(origin, set[hit.direction]);
      ASSERT_TRUE(single);
      const auto place = rays->locate(hit.globalTriangle);
      EXPECT_EQ(place.mesh, single->mesh);
      EXPECT_NEAR(hit.distance, single->distance, 1e-4f * single->distance);
      EXPECT_EQ(hit.backFace, single->backFace);
    }
  }
}

TEST(RayScene, DoesNotMeetLayers) {
  scene::Scene scene = floorAndCeiling();
  const auto before = RayScene::build(scene);
  const std::uint32_t count = std::uint32_t(scene.meshes.size());
  scene::Mesh layer = scene.meshes[0];
  layer.layer = true;
  layer.material = int(scene.materials.size());
  scene.materials.emplace_back().alphaMode = scene::AlphaMode::Blend;
  scene.materials.back().opacity = 0.5f;
  scene.meshes.insert(scene.meshes.begin(), layer);
  const auto after = RayScene::build(scene);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->offset(), before->offset());
  EXPECT_FALSE(Veils(scene).any());
  math::Random random(5, 0, 0);
  std::size_t met = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2 u = random.uniform2();
    const Vec3 origin(u.x() - 0.5f, 0.5f, u.y() - 0.5f);
    const Vec3 direction = math::randomRotation(std::uint64_t(i)) * Vec3::UnitX();
    const auto a = before->closest(origin, direction), b = after->closest(origin, direction);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++met;
    EXPECT_EQ(b->mesh, a->mesh + 1);
    EXPECT_EQ(b->triangle, a->triangle);
    EXPECT_EQ(b->distance, a->distance);
  }
  EXPECT_GT(met, 50u);
  EXPECT_EQ(after->triangleOffsets().size(), count + 2);
  scene.meshes.resize(1);
  EXPECT_FALSE(RayScene::build(scene)) << "layers alone";
}

}  // namespace
}  // namespace lambent::trace
