#include "lambent/transport/receivers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lambent/scene/shapes.h"

namespace lambent::transport {
namespace {

Placement onGrid(const TexelGrid& grid) {
  return {{grid}, {}};
}

TEST(Receivers, VerticesStandWhereTheMeshStands) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1.0f, 1));
  const auto receivers = placeReceivers(scene, {}, 0.0f);
  ASSERT_TRUE(receivers);
  ASSERT_EQ(receivers->size(), scene.meshes[0].positions.size());
  EXPECT_EQ(receivers->positions[7], scene.meshes[0].positions[7]);
  EXPECT_TRUE(receivers->meshes[0].isDiffuse);
}

TEST(Receivers, MirrorsRecordNothingAndBlackIsADiffuseMaterial) {
  scene::Scene scene;
  scene::Material mirror, black;
  mirror.mirror = Rgb::Constant(0.9f);
  black.diffuse = Rgb::Zero();
  scene::addTo(scene, scene::icosphere(1.0f, 0), mirror);
  scene::addTo(scene, scene::icosphere(1.0f, 0), black);
  const auto receivers = placeReceivers(scene, {}, 0.0f);
  ASSERT_TRUE(receivers);
  EXPECT_EQ(receivers->meshes[0].layout, Layout::None);
  EXPECT_EQ(receivers->size(), 12u);
  EXPECT_TRUE(receivers->meshes[1].isDiffuse);
}

TEST(Receivers, TexelsOfAPlaneStandAtTexelCentres) {
  const scene::Scene scene = scene::sceneOf(scene::gridPlane(2.0f, 4.0f, 3, 5));
  const TexelGrid grid{0, 8, 16};
  const auto receivers = placeReceivers(scene, onGrid(grid), 0.0f);
  ASSERT_TRUE(receivers) << receivers.error().message;
  ASSERT_EQ(receivers->size(), 128u);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 8; ++x) {
      const std::uint32_t r = receivers->meshes[0].receiverOfTexel[y * 8 + x];
      const Vec3 expected(-1.0f + 2.0f * (x + 0.5f) / 8, 0.0f, -2.0f + 4.0f * (y + 0.5f) / 16);
      EXPECT_LT((receivers->positions[r] - expected).norm(), 1e-5f);
      EXPECT_EQ(receivers->normals[r], Vec3(0, 1, 0));
    }
}

TEST(Receivers, EmptyTexelsListenToTheNearestFullOne) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 1, 1));
  for (Vec2& uv : scene.meshes[0].uvs) uv *= 0.5f;
  const TexelGrid grid{0, 16, 16};
  const auto receivers = placeReceivers(scene, onGrid(grid), 0.0f);
  ASSERT_TRUE(receivers);
  EXPECT_EQ(receivers->size(), 64u);
  const auto& place = receivers->meshes[0];
  EXPECT_EQ(place.covered[0], 1);
  EXPECT_EQ(place.covered[15], 0);
  EXPECT_EQ(place.receiverOfTexel[3 * 16 + 15], place.receiverOfTexel[3 * 16 + 7]);
}

TEST(Receivers, OriginsLeaveTheEdgeAlongTheSurface) {
  const scene::Scene scene = scene::sceneOf(scene::gridPlane(2.0f, 2.0f, 4, 4));
  const auto receivers = placeReceivers(scene, {}, 1e-3f);
  ASSERT_TRUE(receivers);
  for (std::size_t r = 0; r < receivers->size(); ++r) {
    const Vec3 moved = receivers->origins[r] - receivers->positions[r];
    EXPECT_NEAR(moved.y(), 1e-3f, 1e-7f);
    for (const int axis : {0, 2}) {
      const float at = receivers->positions[r][axis];
      if (std::abs(at) == 1.0f) {
        EXPECT_LT(moved[axis] * at, -1e-4f);  // inwards
      } else {
        EXPECT_LT(std::abs(moved[axis]), 3e-4f);
      }
    }
  }
}

TEST(Receivers, OverlappingUvsAreRefused) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 2, 2));
  for (Vec2& uv : scene.meshes[0].uvs) uv = Vec2(std::abs(uv.x() - 0.5f), uv.y());
  const TexelGrid grid{0, 16, 16};
  const auto receivers = placeReceivers(scene, onGrid(grid), 0.0f);
  ASSERT_FALSE(receivers);
  EXPECT_EQ(receivers.error().kind, ErrorKind::BadInput);
}

TEST(Receivers, SpatialOrderVisitsEveryReceiverOnceAndNeighboursTogether) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 31, 31));
  const auto receivers = placeReceivers(scene, {}, 0.0f);
  ASSERT_TRUE(receivers);
  const std::vector<std::uint32_t> order = spatialOrder(*receivers);
  std::vector<std::uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t r = 0; r < receivers->size(); ++r) EXPECT_EQ(sorted[r], r);
  float length = 0.0f;
  for (std::size_t k = 1; k < order.size(); ++k)
    length += (receivers->positions[order[k]] - receivers->positions[order[k - 1]]).norm();
  EXPECT_LT(length / static_cast<float>(order.size()), 2.5f / 31.0f);
}

TEST(Receivers, DrawingCornersInterpolates) {
  const scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 1, 1));
  const auto vertices = placeReceivers(scene, {}, 0.0f);
  const TexelGrid grid{0, 4, 4};
  const auto texels = placeReceivers(scene, onGrid(grid), 0.0f);
  ASSERT_TRUE(vertices && texels);
  // Positions are linear over the triangle: the mean of the drawn receivers' positions must be the
  // point itself (for texels: anywhere between the outer texel centres).
  for (const PlacedReceivers* receivers : {&*vertices, &*texels}) {
    const float u = 0.3f, v = 0.35f;
    Vec3 mean = Vec3::Zero();
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j)
        mean += receivers->positions[drawReceiver(scene, *receivers, 0, 1, u, v,
                                                  (i + 0.5f) / kSteps, (j + 0.5f) / kSteps)] /
                (kSteps * kSteps);
    const Vec3 expected = scene::surfaceAt(scene, 0, 1, u, v).position;
    EXPECT_LT((mean - expected).norm(), 0.02f);
  }
}

TEST(Receivers, ThoseAroundAPointInterpolateIt) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 2, 2));
  scene::Mesh& mesh = scene.meshes[0];
  for (const Vec2& uv : mesh.uvs) mesh.texelUvs.emplace_back(uv.y(), 1.0f - uv.x());
  for (const Placement& placement : {Placement(), onGrid({0, 8, 5})}) {
    const auto receivers = placeReceivers(scene, placement, 0.0f);
    ASSERT_TRUE(receivers);
    const ReceiversAround around = receiversAround(scene, *receivers, 0, 1, 0.3f, 0.35f);
    Vec3 mean = Vec3::Zero();
    float sum = 0.0f;
    for (std::size_t k = 0; k < around.count; ++k) {
      mean += around.weight[k] * receivers->positions[around.receiver[k]];
      sum += around.weight[k];
    }
    EXPECT_NEAR(sum, 1.0f, 1e-6f);
    EXPECT_LT((mean - scene::surfaceAt(scene, 0, 1, 0.3f, 0.35f).position).norm(), 1e-5f);
  }
}

TEST(Receivers, TexelsBesideAChartMayShowWhatLiesBeyond) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(1.0f, 1.0f, 1, 1));
  for (Vec2& uv : scene.meshes[0].uvs) uv = Vec2(0.25f, 0.25f) + 0.5f * uv;
  scene::SurfacePoint beyond = scene::surfaceAt(scene, 0, 0, 0.2f, 0.2f);
  beyond.position.x() = 7.0f;
  TexelGrid grid{0, 8, 8};
  grid.beyond = {{8 * 4 + 6, beyond}, {8 * 4 + 4, beyond}};  // beside the chart, and in it
  const auto receivers = placeReceivers(scene, onGrid(grid), 0.0f);
  ASSERT_TRUE(receivers);
  const PlacedReceivers::PerMesh& place = receivers->meshes[0];
  const auto at = [&](std::size_t texel) {
    return receivers->positions[place.receiverOfTexel[texel]].x();
  };
  EXPECT_EQ(at(8 * 4 + 6), 7.0f);
  EXPECT_EQ(place.covered[8 * 4 + 6], 0);
  EXPECT_EQ(at(8 * 4 + 7), 7.0f);  // copies the nearest
  EXPECT_LT(at(8 * 4 + 4), 1.0f);  // has a place of its own
  EXPECT_EQ(receivers->size(), 4u * 4u + 1u);
}

}  // namespace
}  // namespace lambent::transport
