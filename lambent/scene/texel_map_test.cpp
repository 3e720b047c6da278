#include "lambent/scene/texel_map.h"

#include <gtest/gtest.h>

#include <limits>

#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

TEST(TexelMap, EveryTexelOfAPlaneShowsItsOwnPlace) {
  const Mesh plane = gridPlane(2.0f, 3.0f, 3, 5);
  const TexelMap map = texelMap(plane, 17, 23);
  for (std::size_t texel = 0; texel < map.size(); ++texel) {
    ASSERT_TRUE(map.covered(texel));
    const Triangle& t = plane.triangles[map.triangle[texel]];
    const Vec2 b = map.barycentric[texel];
    const Vec2 uv =
        (1 - b.x() - b.y()) * plane.uvs[t[0]] + b.x() * plane.uvs[t[1]] + b.y() * plane.uvs[t[2]];
    EXPECT_NEAR(uv.x(), (texel % 17 + 0.5f) / 17, 1e-6f);
    EXPECT_NEAR(uv.y(), (texel / 17 + 0.5f) / 23, 1e-6f);
  }
}

TEST(TexelMap, TrianglesWithoutAreaAndOutsideTheSquareHoldNothing) {
  Mesh mesh;
  mesh.positions.assign(6, Vec3::Zero());
  mesh.uvs = {Vec2(0, 0), Vec2(1, 1), Vec2(0.5f, 0.5f), Vec2(2, 2), Vec2(3, 2), Vec2(2, 3)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const TexelMap map = texelMap(mesh, 8, 8);
  for (std::size_t texel = 0; texel < map.size(); ++texel) EXPECT_FALSE(map.covered(texel));
}

TEST(NearestFull, IsTheNearestOfAll) {
  math::Random random(7, 0);
  for (const auto& [width, height, share] :
       {std::tuple(37, 29, 0.02f), std::tuple(64, 5, 0.1f), std::tuple(1, 40, 0.1f),
        std::tuple(40, 1, 0.1f), std::tuple(30, 30, 0.5f)}) {
    std::vector<std::uint8_t> full(std::size_t(width) * height);
    for (auto& f : full) f = random.uniform() < share;
    full[random.below(static_cast<std::uint32_t>(full.size()))] = 1;
    const std::vector<std::uint32_t> nearest = nearestFull(width, height, full);
    const auto squared = [w = width](std::uint32_t a, std::uint32_t b) {
      const int dx = int(a % w) - int(b % w), dy = int(a / w) - int(b / w);
      return dx * dx + dy * dy;
    };
    for (std::uint32_t t = 0; t < full.size(); ++t) {
      int least = std::numeric_limits<int>::max();
      for (std::uint32_t f = 0; f < full.size(); ++f)
        if (full[f]) least = std::min(least, squared(t, f));
      ASSERT_NE(nearest[t], kNobody);
      ASSERT_TRUE(full[nearest[t]]);
      ASSERT_EQ(squared(t, nearest[t]), least) << width << "×" << height << " texel " << t;
    }
  }
}

TEST(NearestFull, OfNothingIsNobody) {
  const std::vector<std::uint8_t> none(12, 0);
  for (const std::uint32_t n : nearestFull(4, 3, none)) EXPECT_EQ(n, kNobody);
}

}  // namespace
}  // namespace lambent::scene
