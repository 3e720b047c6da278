#include "lambent/meso/generators.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/meso/check_tiling.h"
#include "lambent/meso/periodic_scene.h"

namespace lambent::meso {
namespace {

TEST(Generators, AllAreSoundAndTile) {
  for (const std::string_view name : generatorNames()) {
    const std::optional<Patch> patch = generate(name, Vec2(0.2f, 0.1f), 7);
    ASSERT_TRUE(patch) << name;
    EXPECT_EQ(patch->size, Vec2(0.2f, 0.1f));
    EXPECT_EQ(patch->name, name);
    const Result<Findings> findings = check(*patch);
    ASSERT_TRUE(findings) << name;
    EXPECT_TRUE(findings->empty()) << name << ": " << findings->front().message;
    EXPECT_TRUE(checkTiling(*patch).empty()) << name << checkTiling(*patch).front().message;
    const Extent extent = extentOf(*patch);
    EXPECT_GT(extent.depth(), 0.002f) << name;
  }
  EXPECT_FALSE(generate("no such thing", Vec2(1, 1)));
}

TEST(Generators, NoRayFindsAGapOrABack) {
  // From above, every ray meets a front, at the tile's borders too.
  for (const std::string_view name : generatorNames()) {
    const std::optional<Patch> patch = generate(name, Vec2(0.1f, 0.1f));
    auto scene = PeriodicScene::build(*patch);
    ASSERT_TRUE(scene) << name;
    const float top = scene->extent().highest + 0.001f;
    int met = 0;
    for (int k = 0; k < 64 * 64; ++k) {
      const Vec3 from(0.1f * float(k % 64) / 64, 0.1f * float(k / 64) / 64, top);
      PeriodicHit hit;
      met += scene->trace(from, Vec3(0, 0, -1), hit) == RayEnd::Lit;
      met += scene->trace(from, Vec3(0.5f, 0.3f, -0.6f).normalized(), hit) == RayEnd::Lit;
    }
    EXPECT_EQ(met, 2 * 64 * 64) << name;
  }
}

TEST(Generators, NormalsLeanWithTheirTriangles) {
  for (const std::string_view name : generatorNames()) {
    const std::optional<Patch> patch = generate(name, Vec2(0.1f, 0.1f));
    std::size_t against = 0, count = 0;
    for (const scene::Mesh& mesh : patch->scene.meshes)
      for (const scene::Triangle& t : mesh.triangles) {
        const Vec3 flat = (mesh.positions[t[1]] - mesh.positions[t[0]])
                              .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                              .normalized();
        for (const std::uint32_t corner : t) {
          EXPECT_NEAR(mesh.normals[corner].norm(), 1.0f, 1e-4f);
          against += mesh.normals[corner].dot(flat) < 0.2f, ++count;
        }
      }
    EXPECT_LT(double(against), 0.002 * double(count)) << name;
  }
}

TEST(Generators, ThreadsOfTheWeaveGoOverAndUnder) {
  const Patch patch = weave();
  auto scene = PeriodicScene::build(patch);
  ASSERT_TRUE(scene);
  // Which mesh is seen at the four crossings: 0 warp, 1 weft, in a chequerboard.
  std::uint32_t seen[2][2];
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      PeriodicHit hit;
      ASSERT_EQ(
          scene->trace(Vec3(0.025f + 0.05f * x, 0.025f + 0.05f * y, 0.1f), Vec3(0, 0, -1), hit),
          RayEnd::Lit);
      seen[y][x] = scene->meshOf(hit.triangle);
    }
  EXPECT_NE(seen[0][0], seen[0][1]);
  EXPECT_EQ(seen[0][0], seen[1][1]);
  EXPECT_EQ(seen[0][1], seen[1][0]);
  // Between four threads there is a gap, and the backing under it.
  PeriodicHit hit;
  ASSERT_EQ(scene->trace(Vec3(0.05f, 0.05f, 0.1f), Vec3(0, 0, -1), hit), RayEnd::Lit);
  EXPECT_EQ(scene->meshOf(hit.triangle), 2u);
}

TEST(Generators, EveryLoopOfTheKnitComesThroughTheOneBelow) {
  KnitOptions options;
  options.stitches = 1, options.courses = 3, options.size = Vec2(0.04f, 0.09f);
  options.plies = 0, options.around = 12, options.along = 48;
  const Patch patch = knit(options);
  ASSERT_EQ(patch.scene.meshes.size(), 3u);
  // Where axes of courses 0 and 1 cross, seen from above: on the way up from its foot a loop of
  // course 1 first passes under course 0 (a leg), then over it (the head).
  const auto axis = [&](int course, int row) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < options.around; ++k)
      sum += patch.scene.meshes[course].positions[std::size_t(row * options.around + k)];
    return Vec3(sum / float(options.around));
  };
  std::vector<bool> over;
  float nearest = 1.0f;
  // From the foot (a quarter of the way along) to the head.
  for (int i = options.along / 4; i < 3 * options.along / 4; ++i)
    for (int j = 0; j < options.along; ++j)
      for (float shift : {-0.04f, 0.0f, 0.04f}) {
        const Vec3 a = axis(1, i), b = axis(0, j) + Vec3(shift, 0, 0);
        nearest = std::min(nearest, (a - b).norm());
        const Vec3 da = axis(1, i + 1) - a, db = axis(0, j + 1) + Vec3(shift, 0, 0) - b;
        const float det = da.x() * -db.y() + db.x() * da.y();
        if (det == 0.0f) continue;
        const Vec3 r = b - a;
        const float s = (r.x() * -db.y() + db.x() * r.y()) / det;
        const float t = (da.x() * r.y() - da.y() * r.x()) / det;
        if (s < 0 || s >= 1 || t < 0 || t >= 1) continue;
        over.push_back(a.z() + s * da.z() > b.z() + t * db.z());
      }
  EXPECT_EQ(over, (std::vector<bool>{false, true}));
  // Yarns do not run into each other by more than a tenth of their thickness.
  EXPECT_GT(nearest, 0.9f * options.yarn * 0.04f);
}

TEST(Generators, RandomProcessesFollowTheirSeed) {
  for (const std::string_view name : {"pebbles", "stucco", "plaster"}) {
    const Patch a = *generate(name, Vec2(0.1f, 0.1f), 1), b = *generate(name, Vec2(0.1f, 0.1f), 1);
    const Patch c = *generate(name, Vec2(0.1f, 0.1f), 2);
    EXPECT_EQ(a.scene.meshes[0].positions, b.scene.meshes[0].positions);
    EXPECT_NE(a.scene.meshes[0].positions, c.scene.meshes[0].positions);
  }
}

}  // namespace
}  // namespace lambent::meso
