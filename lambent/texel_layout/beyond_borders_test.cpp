#include "lambent/texel_layout/beyond_borders.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/scene/shapes.h"
#include "lambent/scene/texel_map.h"

namespace lambent::texel_layout {
namespace {

/// A floor of 4×4 m, cut at x = 0 into two charts of 8×16 texels of a 32×32 grid, which lie apart
/// and turned: the left one upright, the right one a half turn round.
scene::Scene floorInTwo(int quads) {
  scene::Mesh mesh = scene::gridPlane(4, 4, quads, quads);
  mesh.uvs.clear();
  scene::Mesh cut = mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  cut.positions.insert(cut.positions.end(), mesh.positions.begin(), mesh.positions.end());
  cut.normals.insert(cut.normals.end(), mesh.normals.begin(), mesh.normals.end());
  for (const Vec3& p : mesh.positions)
    cut.texelUvs.emplace_back((4.0f + 4.0f * (p.x() + 2.0f)) / 32.0f,
                              (4.0f + 4.0f * (p.z() + 2.0f)) / 32.0f);
  for (const Vec3& p : mesh.positions)
    cut.texelUvs.emplace_back((28.0f - 4.0f * p.x()) / 32.0f,
                              (28.0f - 4.0f * (p.z() + 2.0f)) / 32.0f);
  for (scene::Triangle& t : cut.triangles) {
    float middle = 0.0f;
    for (const std::uint32_t v : t) middle += mesh.positions[v].x();
    if (middle > 0.0f)
      for (std::uint32_t& v : t) v += vertices;
  }
  return scene::sceneOf(cut);
}

TEST(BeyondBorders, ShowTheSurfaceAcrossACut) {
  for (const int quads : {2, 6, 16}) {
    const scene::Scene scene = floorInTwo(quads);
    const auto beyond = beyondBorders(scene, 0, smoothSurface(scene.meshes[0]), 32);
    int across = 0;
    for (const auto& [texel, point] : beyond) {
      const float x = float(texel % 32) + 0.5f, y = float(texel / 32) + 0.5f;
      EXPECT_NEAR(point.position.y(), 0.0f, 1e-6f);
      // Where the plane that the chart lies in goes on to, and is still floor.
      const Vec2 left(-2.0f + (x - 4.0f) / 4.0f, -2.0f + (y - 4.0f) / 4.0f);
      const Vec2 right((28.0f - x) / 4.0f, -2.0f + (28.0f - y) / 4.0f);
      const Vec2 on = x < 16.0f ? left : right, at(point.position.x(), point.position.z());
      const bool overCut = x < 16.0f ? on.x() > 0.0f : on.x() < 0.0f;
      if (overCut && std::abs(on.y()) < 1.9f) {
        ++across;
        EXPECT_TRUE(at.isApprox(on, 1e-4f))
            << quads << ": " << at.transpose() << ", " << on.transpose();
      } else if (!overCut) {
        // At the floor's own edge: the last place before it.
        EXPECT_LT((at - on.cwiseMax(-2.0f).cwiseMin(2.0f)).norm(), 0.02f);
      }
    }
    EXPECT_EQ(across, 2 * 16);
    EXPECT_EQ(beyond.size(), 2u * (2 * 8 + 2 * 16 + 4));
  }
}

// Over the edge of a box no surface goes on as it was: each face keeps to itself.
TEST(BeyondBorders, StopAtCreases) {
  scene::Scene scene = scene::sceneOf(scene::box(Vec3(2, 2, 2), 4));
  for (const auto& [texel, point] : beyondBorders(scene, 0, smoothSurface(scene.meshes[0]), 48)) {
    Vec3 size = point.position.cwiseAbs();
    const Vec3 normal = point.normal.cwiseAbs();
    EXPECT_NEAR(size.dot(normal), 1.0f, 1e-6f);                       // on its own face
    EXPECT_GT((size - normal.cwiseProduct(size)).maxCoeff(), 0.98f);  // at its border
    EXPECT_LT((size - normal.cwiseProduct(size)).maxCoeff(), 1.0f);   // and not on it
  }
}

}  // namespace
}  // namespace lambent::texel_layout
