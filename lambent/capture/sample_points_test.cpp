#include "lambent/capture/sample_points.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "lambent/scene/shapes.h"

namespace lambent::capture {
namespace {

using scene::Scene;

/// Two squares of area 1 and 3, one above the other.
Scene twoSquares() {
  Scene scene;
  scene::addTo(scene, scene::gridPlane(1, 1, 1, 1), {});
  scene::addTo(scene, scene::translated(scene::gridPlane(1, 3, 9, 2), Vec3(0, 4, 0)), {});
  return scene;
}

/// The largest distance from a point of `a` to the nearest of `b`.
float worstDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  float worst = 0;
  for (const Vec3& p : a) {
    float nearest = 1e9f;
    for (const Vec3& q : b) nearest = std::min(nearest, (p - q).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(SamplePoints, OneIsTheCentroidOfTheArea) {
  const SamplePoints result = samplePoints(twoSquares(), 1);
  ASSERT_EQ(result.points.size(), 1u);
  EXPECT_LT((result.points[0] - Vec3(0, 3, 0)).norm(), 1e-5f);
  // Variance of the height, and of the places within the squares: (1 + w²)/12 each.
  const double expected = 0.25 * 0.75 * 16 + 0.25 * 2 / 12.0 + 0.75 * 10 / 12.0;
  EXPECT_NEAR(result.distortions.back(), expected, 1e-5);
}

TEST(SamplePoints, DistortionNeverRises) {
  const Scene torus = scene::sceneOf(scene::torus(1, 0.4f, 60, 30));
  double ofFewer = samplePoints(torus, 1).distortions.back();
  for (const int count : {2, 3, 5, 8, 16, 40}) {
    const SamplePoints result = samplePoints(torus, count);
    ASSERT_EQ(int(result.points.size()), count);
    for (std::size_t i = 1; i < result.distortions.size(); ++i)
      EXPECT_LE(result.distortions[i], result.distortions[i - 1] * (1 + 1e-12)) << count;
    EXPECT_LT(result.distortions.back(), ofFewer) << count;
    ofFewer = result.distortions.back();
  }
}

// A surface spread evenly over K cells of area A/K has at least the distortion of discs of that
// area, A/(2πK).
TEST(SamplePoints, OfAPlaneAreNearlyTheBestPossible) {
  const SamplePoints result = samplePoints(scene::sceneOf(scene::gridPlane(2, 2, 3, 3)), 64);
  const double discs = 4.0 / (2 * kPi * 64);
  EXPECT_GT(result.distortions.back(), discs);
  EXPECT_LT(result.distortions.back(), 1.12 * discs);
}

TEST(SamplePoints, FindsClusters) {
  Scene scene;
  std::vector<Vec3> centers;
  for (int i = 0; i < 7; ++i) {
    centers.emplace_back(10 * std::cos(0.9f * i), 2.0f * i, 10 * std::sin(0.9f * i));
    scene::addTo(scene, scene::translated(scene::icosphere(0.5f, 1 + i % 3), centers.back()), {});
  }
  const SamplePoints result = samplePoints(scene, 7);
  ASSERT_EQ(result.points.size(), 7u);
  EXPECT_LT(worstDistance(centers, result.points), 1e-3f);
}

TEST(SamplePoints, DoNotFollowTheTessellation) {
  // The same plane, one half of it cut into 50 times as many triangles.
  Scene coarse, fine;
  for (const float x : {-1.0f, 1.0f})
    scene::addTo(coarse, scene::translated(scene::gridPlane(2, 1, 4, 2), Vec3(x, 0, 0)), {});
  scene::addTo(fine, coarse.meshes[0], {});
  scene::addTo(fine, scene::translated(scene::gridPlane(2, 1, 40, 20), Vec3(1, 0, 0)), {});
  const SamplePoints a = samplePoints(coarse, 6), b = samplePoints(fine, 6);
  EXPECT_LT(worstDistance(a.points, b.points), 0.02f);
  EXPECT_NEAR(a.distortions.back(), b.distortions.back(), 0.01 * a.distortions.back());
}

TEST(SamplePoints, TheSameInputGivesTheSamePoints) {
  const Scene torus = scene::sceneOf(scene::torus(1, 0.3f, 31, 17));
  const SamplePoints a = samplePoints(torus, 13), b = samplePoints(torus, 13);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]);
}

TEST(SamplePoints, ScaleAndPlaceDoNotMatter) {
  // Without symmetries, where rounding would decide.
  const scene::Mesh mesh = scene::scaled(scene::icosphere(1, 3), Vec3(3, 1, 0.5f));
  const auto small = samplePoints(
      scene::sceneOf(scene::translated(scene::scaled(mesh, Vec3::Constant(1e-3f)), Vec3(5, 0, 0))),
      4);
  const auto large = samplePoints(scene::sceneOf(mesh), 4);
  ASSERT_EQ(small.points.size(), 4u);
  std::vector<Vec3> back;
  for (const Vec3& p : small.points) back.push_back((p - Vec3(5, 0, 0)) * 1e3f);
  EXPECT_LT(worstDistance(back, large.points), 0.02f);
}

TEST(SamplePoints, AreNoMoreThanThereArePlaces) {
  Scene scene;  // two specks, far apart
  for (const float x : {0.0f, 100.0f})
    scene::addTo(scene, scene::translated(scene::icosphere(1e-3f, 1), Vec3(x, 0, 0)), {});
  const SamplePoints result = samplePoints(scene, 9);
  EXPECT_GE(result.points.size(), 2u);
  EXPECT_LE(result.points.size(), 9u);
  EXPECT_LT(worstDistance({Vec3(0, 0, 0), Vec3(100, 0, 0)}, result.points), 1e-2f);
  for (const Vec3& p : result.points) EXPECT_TRUE(p.allFinite());
}

}  // namespace
}  // namespace lambent::capture
