#include "lambent/transport/texel_seams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/scene/shapes.h"
#include "lambent/transport/texel_taps.h"

namespace lambent::transport {
namespace {

/// A mesh on texels, and a value for each of them by what is at the place of the surface that it
/// copies.
struct Grid {
  scene::Mesh mesh;
  PlacedReceivers receivers;

  Grid(scene::Mesh of, int width, int height) : mesh(std::move(of)) {
    receivers = *placeReceivers(scene::sceneOf(mesh), {{{0, width, height}}, {}}, 0.0f);
  }
  const PlacedReceivers::PerMesh& place() const { return receivers.meshes[0]; }
  template <class Value>
  std::vector<float> rows(const Value& valueAt) const {
    std::vector<float> values;
    for (const std::uint32_t r : place().receiverOfTexel)
      values.push_back(valueAt(receivers.positions[r]));
    return values;
  }
  double at(const std::vector<float>& rows, const Vec2& uv) const {
    const TexelTaps taps = tapsAt(uv, place().width, place().height);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += taps.weights[k] * double(rows[taps.texels[k]]);
    return sum;
  }
};

TEST(TexelSeams, OfASphereShowNoStep) {
  const Grid grid(scene::uvSphere(1.0f, 40, 20), 40, 20);
  const TexelSeams seams(grid.mesh, grid.place());
  ASSERT_FALSE(seams.empty());
  const auto value = [](const Vec3& p) { return 1.0f + p.z() + 0.5f * p.x() * p.y(); };
  const std::vector<float> before = grid.rows(value);
  std::vector<float> after = before;
  seams.close({after.data(), 1});
  double stepBefore = 0.0, stepAfter = 0.0;
  for (float v = 0.1f; v < 0.9f; v += 0.01f) {
    const Vec2 one(0.0f, v), other(1.0f, v);
    stepBefore = std::max(stepBefore, std::abs(grid.at(before, one) - grid.at(before, other)));
    stepAfter = std::max(stepAfter, std::abs(grid.at(after, one) - grid.at(after, other)));
    // Where both agree is between what they showed.
    EXPECT_NEAR(grid.at(after, one), 0.5 * (grid.at(before, one) + grid.at(before, other)), 0.02);
  }
  EXPECT_GT(stepBefore, 0.1);
  EXPECT_LT(stepAfter, 0.03 * stepBefore);
  // Two texels away everything is as it was.
  for (int y = 2; y < 18; ++y)
    for (int x = 2; x < 38; ++x) EXPECT_EQ(after[y * 40 + x], before[y * 40 + x]);
}

TEST(TexelSeams, LeaveWhatIsTheSameAlongThem) {
  const Grid grid(scene::uvSphere(1.0f, 24, 12), 24, 12);
  std::vector<float> rows;
  for (const std::uint32_t r : grid.place().receiverOfTexel) {
    rows.push_back(0.7f);
    rows.push_back(grid.receivers.positions[r].y());
  }
  const std::vector<float> before = rows;
  TexelSeams(grid.mesh, grid.place()).close({rows.data(), 2});
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_NEAR(rows[k], before[k], 1e-5f);
}

TEST(TexelSeams, AreNoneAtHardEdgesAndOfOnePiece) {
  const Grid box(scene::box(Vec3::Ones()), 48, 32), plane(scene::gridPlane(1, 1, 4, 4), 8, 8);
  EXPECT_TRUE(TexelSeams(box.mesh, box.place()).empty());
  EXPECT_TRUE(TexelSeams(plane.mesh, plane.place()).empty());
}

// A plane in two charts that lie apart and are turned against each other.
TEST(TexelSeams, JoinChartsWithGutters) {
  scene::Mesh left = scene::gridPlane(1, 1, 2, 2), right = scene::gridPlane(1, 1, 2, 2);
  for (Vec2& uv : left.uvs) uv = Vec2(0.05f, 0.05f) + 0.4f * uv;
  for (Vec2& uv : right.uvs) uv = Vec2(0.95f - 0.4f * uv.y(), 0.55f + 0.4f * uv.x());
  const scene::Mesh parts[] = {left, scene::translated(std::move(right), Vec3(1, 0, 0))};
  const Grid grid(scene::merge(parts), 20, 20);
  const auto value = [](const Vec3& p) { return p.x() + 0.3f * p.z(); };
  const std::vector<float> before = grid.rows(value);
  std::vector<float> after = before;
  TexelSeams(grid.mesh, grid.place()).close({after.data(), 1});
  const auto stepOf = [&](const std::vector<float>& rows) {
    double step = 0.0;
    for (float v = 0.1f; v < 0.9f; v += 0.02f)
      step = std::max(step, std::abs(grid.at(rows, Vec2(0.45f, 0.05f + 0.4f * v)) -
                                     grid.at(rows, Vec2(0.95f - 0.4f * v, 0.55f))));
    return step;
  };
  EXPECT_GT(stepOf(before), 0.1);
  EXPECT_LT(stepOf(after), 0.03 * stepOf(before));
}

}  // namespace
}  // namespace lambent::transport
