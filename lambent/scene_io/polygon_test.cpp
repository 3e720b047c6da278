#include "lambent/scene_io/polygon.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace lambent::scene_io {
namespace {

double areaOf(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

/// Cuts a polygon in the plane z = height and checks that its triangles fill it: n−2 of them, none
/// turned over, and areas that add up.
void expectFilled(const std::vector<Vec3d>& corners) {
  std::vector<scene::Triangle> triangles;
  EXPECT_TRUE(cutPolygon(corners, triangles));
  ASSERT_EQ(triangles.size(), corners.size() - 2);
  double twice = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  for (const auto& [a, b, c] : triangles) {
    const Vec3d ab = corners[b] - corners[a], ac = corners[c] - corners[a];
    const double turned = ab.x() * ac.y() - ab.y() * ac.x();
    EXPECT_GT(turned, 0.0);
    sum += areaOf(corners[a], corners[b], corners[c]);
  }
  EXPECT_NEAR(sum, 0.5 * twice, 1e-9 * twice);
}

std::vector<Vec3d> comb(int teeth) {
  std::vector<Vec3d> corners = {{0, 0, 0}, {2.0 * teeth, 0, 0}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double x = 2.0 * i;
    corners.insert(
        corners.end(),
        {{x + 2, 1, 0}, {x + 1.5, 1, 0}, {x + 1.5, 5, 0}, {x + 0.5, 5, 0}, {x + 0.5, 1, 0}});
  }
  corners.push_back({0, 1, 0});
  return corners;
}

TEST(Polygon, ArrowheadsFromEveryCorner) {
  const std::vector<Vec3d> arrow = {{-1, 0, 0}, {0, 0.5, 0}, {1, 0, 0}, {0, 2, 0}};
  for (std::size_t start = 0; start < 4; ++start) {
    std::vector<Vec3d> corners = arrow;
    std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(start), corners.end());
    expectFilled(corners);
  }
}

TEST(Polygon, CombsOfAnySize) {
  for (const int teeth : {1, 3, 20, 500, 5000}) expectFilled(comb(teeth));
}

TEST(Polygon, Stars) {
  for (const int points : {20, 3000}) {
    std::vector<Vec3d> star;
    for (int i = 0; i < 2 * points; ++i) {
      const double r = i % 2 ? 1.0 : 0.3, a = kPi * i / points;
      star.emplace_back(r * std::cos(a), r * std::sin(a), 7.0);
    }
    expectFilled(star);
  }
}

TEST(Polygon, Spirals) {
  std::vector<Vec3d> spiral;
  constexpr int kSteps = 4000;
  const auto at = [](int i, double width) {
    const double a = 0.02 * i, r = 1.0 + 0.1 * a + width;
    return Vec3d(r * std::cos(a), r * std::sin(a), 0.0);
  };
  for (int i = 0; i < kSteps; ++i) spiral.push_back(at(i, 0.3));
  for (int i = kSteps; i-- > 0;) spiral.push_back(at(i, 0.0));
  expectFilled(spiral);
}

TEST(Polygon, StraightCornersMakeNoSliversWhereThereIsAnotherWay) {
  std::vector<Vec3d> square;
  for (int i = 0; i < 5; ++i) square.emplace_back(i, 0, 0);
  for (int i = 1; i < 5; ++i) square.emplace_back(4, i, 0);
  for (int i = 3; i >= 0; --i) square.emplace_back(i, 4, 0);
  for (int i = 3; i >= 1; --i) square.emplace_back(0, i, 0);
  expectFilled(square);
}

TEST(Polygon, HolesByABridge) {
  // A square with a square hole: the way there and back is the same.
  expectFilled({{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 3, 0},
                {3, 3, 0},
                {3, 1, 0},
                {1, 1, 0}});
}

TEST(Polygon, CrossingsAreSaid) {
  std::vector<scene::Triangle> triangles;
  const std::vector<Vec3d> bow = {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}};
  EXPECT_FALSE(cutPolygon(bow, triangles));
  EXPECT_EQ(triangles.size(), 2u);
  // A scribble of many corners is broken off.
  std::vector<Vec3d> scribble;
  for (int i = 0; i < 5000; ++i) {
    scribble.emplace_back(std::sin(1.7 * i) + 0.001 * i, std::cos(2.3 * i * i), 0.0);
  }
  triangles.clear();
  EXPECT_FALSE(cutPolygon(scribble, triangles));
  EXPECT_EQ(triangles.size(), scribble.size() - 2);
}

TEST(Polygon, FarFromTheOriginAndInAnyPlane) {
  std::vector<Vec3d> corners = comb(30);
  const Vec3d x = Vec3d(1, 2, 3).normalized(), y = x.unitOrthogonal();
  std::vector<scene::Triangle> triangles;
  for (Vec3d& p : corners) p = Vec3d(448251, 5411930, 200) + p.x() * x + p.y() * y;
  EXPECT_TRUE(cutPolygon(corners, triangles));
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += areaOf(corners[a], corners[b], corners[c]);
  EXPECT_NEAR(sum, 30 * 6.0, 1e-4);
}

}  // namespace
}  // namespace lambent::scene_io
