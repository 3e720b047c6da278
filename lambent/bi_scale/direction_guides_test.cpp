#include "lambent/bi_scale/direction_guides.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/scene/shapes.h"

namespace lambent::bi_scale {
namespace {

TEST(DirectionGuides, FollowTheNearestCurveAndFadeWithTheDistance) {
  const scene::Mesh plane = scene::gridPlane(2, 2, 8, 8);
  CurveSteering steering;
  steering.curves = {{Vec3(-1, 0, -1), Vec3(-1, 0, 0), Vec3(-1, 0, 1)},
                     {Vec3(-0.9f, 0, 1), Vec3(1, 0, 1)}};
  steering.reach = 0.5f;
  const auto guides = guidesBy(steering, plane);
  ASSERT_EQ(guides.size(), plane.positions.size());
  for (std::size_t v = 0; v < guides.size(); ++v) {
    const Vec3& p = plane.positions[v];
    const float left = p.x() + 1.0f;
    const float front = (Vec3(std::max(p.x(), -0.9f), 0, 1) - p).norm();
    const float distance = std::min(left, front);
    const float share = std::max(0.0f, 1.0f - distance / 0.5f);
    EXPECT_NEAR(guides[v].weight, share * share, 1e-5f) << p.transpose();
    if (share == 0.0f || std::abs(left - front) < 1e-5f) continue;
    const Vec3 expected = left < front ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
    EXPECT_LT((guides[v].direction - expected).norm(), 1e-5f) << p.transpose();
  }
}

TEST(DirectionGuides, APictureSaysRightAndUpOfItself) {
  const scene::Mesh plane = scene::gridPlane(2, 2, 8, 8);  // u along +x, v along +z
  PictureSteering steering;
  steering.picture.width = 3, steering.picture.height = 1;
  // Right; up and left by a half; grey.
  steering.picture.rgba = {255, 128, 0, 255, 82, 173, 0, 255, 127, 128, 9, 255};
  const auto guides = guidesBy(steering, plane);
  ASSERT_TRUE(guides);
  for (std::size_t v = 0; v < guides->size(); ++v) {
    const float u = plane.uvs[v].x();
    const synthesis::Guide& guide = (*guides)[v];
    if (u < 0.33f) {
      EXPECT_GT(guide.direction.normalized().dot(Vec3::UnitX()), 0.999f);
      EXPECT_NEAR(guide.weight, 1.0f, 1e-2f);
    } else if (u < 0.66f) {
      EXPECT_GT(guide.direction.normalized().dot(Vec3(-1, 0, -1).normalized()), 0.999f);
      EXPECT_NEAR(guide.weight, 0.5f, 1e-2f);
    } else if (u < 0.99f) {
      EXPECT_EQ(guide.weight, 0.0f);
    }
  }
  scene::Mesh bare = plane;
  bare.uvs.clear();
  EXPECT_FALSE(guidesBy(steering, bare));
}

}  // namespace
}  // namespace lambent::bi_scale
