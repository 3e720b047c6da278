#include "lambent/synthesis/place_ids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Geometry>

#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/texel_map.h"
#include "lambent/scene/uv_steps.h"
#include "lambent/work/thread_limit.h"

namespace lambent::synthesis {
namespace {

atlas::Atlas atlasOf(const scene::Mesh& mesh, int size, bool ownUvs) {
  auto made = atlas::makeAtlas(mesh, {.size = size, .ownUvs = ownUvs}, {});
  EXPECT_TRUE(made);
  return std::move(made->value);
}

void add(MesoMesh& mesh, const Vec3& position, const Vec3& normal, const Vec3& tangent) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.tangents.push_back(tangent);
  mesh.levelEnd = {static_cast<std::uint32_t>(mesh.positions.size())};
}

/// Points anywhere on a square of a metre in the plane y = height.
MesoMesh scattered(int count, float height, float normalY, std::uint64_t seed) {
  MesoMesh mesh;
  math::Random random(seed, 0);
  for (int i = 0; i < count; ++i)
    add(mesh, Vec3(random.uniform() - 0.5f, height, random.uniform() - 0.5f), Vec3(0, normalY, 0),
        Vec3(1, 0, 0));
  return mesh;
}

/// How far two ids are apart, around the torus.
int apart(int a, int b) {
  const int d = std::abs(a - b);
  return std::min(d, 65536 - d);
}

TEST(PlaceIds, APlanesOwnCoordinatesComeBackToTheLastBit) {
  const atlas::Atlas plane = atlasOf(scene::gridPlane(1, 1, 5, 5), 96, true);
  ASSERT_TRUE(plane.ownUvs);
  const MesoMesh mesh = scattered(2000, 0.0f, 1.0f, 1);
  const Vec2 patch(0.3f, 0.45f);
  // Normal +y, tangent +x: across is normal × tangent = −z.
  const auto place = [&](float x, float z) { return Vec2(x / patch.x(), -z / patch.y()); };
  std::vector<Vec2> q;
  for (const Vec3& p : mesh.positions) {
    const Vec2 at = place(p.x(), p.z());
    q.emplace_back(at.x() - std::floor(at.x()), at.y() - std::floor(at.y()));
  }
  const Result<transfer::IdMap> ids =
      placeIds(plane, mesh, q, {.size = 96, .patchSize = patch}, {});
  ASSERT_TRUE(ids);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const Vec2 at = place((x + 0.5f) / 96 - 0.5f, (y + 0.5f) / 96 - 0.5f);
      for (int k = 0; k < 2; ++k) {
        const double exact = (double(at[k]) - std::floor(double(at[k]))) * 65536.0;
        EXPECT_LE(apart(ids->ids[2 * (std::size_t(y) * 96 + x) + k],
                        static_cast<int>(std::lround(exact)) & 0xffff),
                  1);
      }
    }
}

TEST(PlaceIds, ShootsAtTheSheetThatFacesTheSameWay) {
  // A sheet a hundredth as thick as its vertices are apart. Above all is 0.2, below all is 0.7, and
  // the patch is so large that offsets hardly count.
  scene::Mesh sheets[2] = {
      scene::translated(scene::gridPlane(1, 1, 1, 1), Vec3(0, 1e-4f, 0)),
      scene::translated(scene::flipped(scene::gridPlane(1, 1, 1, 1)), Vec3(0, -1e-4f, 0))};
  for (Vec2& uv : sheets[0].uvs) uv.x() = 0.05f + 0.4f * uv.x();
  for (Vec2& uv : sheets[1].uvs) uv.x() = 0.55f + 0.4f * uv.x();
  const atlas::Atlas atlas = atlasOf(scene::merge(sheets), 64, true);
  ASSERT_TRUE(atlas.ownUvs);
  MesoMesh mesh = scattered(3000, 1e-4f, 1.0f, 2);
  const MesoMesh below = scattered(9000, -1e-4f, -1.0f, 3);
  std::vector<Vec2> q(mesh.positions.size(), Vec2(0.2f, 0.2f));
  for (std::size_t i = 0; i < below.positions.size(); ++i)
    add(mesh, below.positions[i], below.normals[i], below.tangents[i]);
  q.resize(mesh.positions.size(), Vec2(0.7f, 0.7f));
  for (const int neighbours : {1, 20}) {
    const Result<transfer::IdMap> ids = placeIds(
        atlas, mesh, q, {.size = 64, .neighbours = neighbours, .patchSize = Vec2(1e4f, 1e4f)}, {});
    ASSERT_TRUE(ids);
    const scene::TexelMap map = scene::texelMap(atlas.mesh, 64, 64);
    for (std::size_t texel = 0; texel < map.size(); ++texel) {
      if (!map.covered(texel)) continue;
      const bool above = map.triangle[texel] < 2;
      EXPECT_LE(apart(ids->ids[2 * texel], above ? 13107 : 45875), 8) << texel;
    }
  }
}

TEST(PlaceIds, OfTheNearestTakesTheOneNearestToTheNormalsLine) {
  const atlas::Atlas plane = atlasOf(scene::gridPlane(1, 1, 1, 1), 8, true);
  MesoMesh mesh;
  add(mesh, Vec3(0.1f, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0));      // nearest to the point
  add(mesh, Vec3(0.01f, 0.2f, 0), Vec3(0, 1, 0), Vec3(1, 0, 0));  // nearest to the line
  add(mesh, Vec3(0, 0.1f, 0), Vec3(0, -1, 0), Vec3(1, 0, 0));     // on the line, facing away
  const std::vector<Vec2> q = {Vec2(0.1f, 0), Vec2(0.5f, 0), Vec2(0.9f, 0)};
  const Result<transfer::IdMap> ids =
      placeIds(plane, mesh, q, {.size = 1, .patchSize = Vec2(1e4f, 1e4f)}, {});
  ASSERT_TRUE(ids);
  EXPECT_LE(apart(ids->ids[0], 32768), 2);
}

// Between texel centres places go on as the patch does: beyond a chart's border, too.
TEST(PlaceIds, EveryOtherTexelContinuesThePatchOfItsChart) {
  const int size = 64;
  scene::Mesh half = scene::gridPlane(1, 1, 3, 3);
  for (Vec2& uv : half.uvs) uv = 0.5f * uv + Vec2(0.2f, 0.3f);
  const atlas::Atlas atlas = atlasOf(half, size, true);
  ASSERT_TRUE(atlas.ownUvs);
  MesoMesh mesh;
  add(mesh, Vec3(0.1f, 0, -0.2f), Vec3(0, 1, 0), Vec3(0.6f, 0, 0.8f));
  const std::vector<Vec2> q = {Vec2(0.3f, 0.7f)};
  const Result<transfer::IdMap> ids =
      placeIds(atlas, mesh, q, {.size = size, .patchSize = Vec2(0.5f, 0.25f)}, {});
  ASSERT_TRUE(ids);
  const scene::UvSteps steps = scene::uvSteps(atlas.mesh, 0);
  const std::uint32_t corner = atlas.mesh.triangles[0][0];
  const Vec3 across = mesh.normals[0].cross(mesh.tangents[0]);
  int outside = 0;
  const scene::TexelMap map = scene::texelMap(atlas.mesh, size, size);
  for (int t = 0; t < size * size; ++t) {
    outside += !map.covered(std::size_t(t));
    const Vec2 uv = Vec2(float(t % size) + 0.5f, float(t / size) + 0.5f) / float(size);
    const Vec2 d = uv - atlas.mesh.uvs[corner];
    const Vec3 offset =
        atlas.mesh.positions[corner] + d.x() * steps.u + d.y() * steps.v - mesh.positions[0];
    const Vec2 expected =
        q[0] + Vec2(offset.dot(mesh.tangents[0]) / 0.5f, offset.dot(across) / 0.25f);
    for (int c = 0; c < 2; ++c) {
      const auto id = std::lround((expected[c] - std::floor(expected[c])) * 65536) & 0xffff;
      ASSERT_LE(apart(ids->ids[std::size_t(2 * t + c)], int(id)), 4) << uv.transpose();
    }
  }
  EXPECT_GT(outside, 1000);
}

TEST(PlaceIds, AreTheSameOnOneThread) {
  const int size = 80;
  const atlas::Atlas atlas = atlasOf(scene::icosphere(1.0f, 2), size, false);
  MesoMesh mesh;
  math::Random random(9, 9);
  std::vector<Vec2> q;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 n = math::randomRotation(i + 1).col(0);
    add(mesh, n, n, n.unitOrthogonal());
    q.push_back(random.uniform2());
  }
  const Result<transfer::IdMap> ids = placeIds(atlas, mesh, q, {.size = size}, {});
  const work::ThreadLimit one(1);
  const Result<transfer::IdMap> alone = placeIds(atlas, mesh, q, {.size = size}, {});
  ASSERT_TRUE(ids && alone);
  EXPECT_EQ(alone->ids, ids->ids);
}

TEST(PlaceIds, AChartWithoutATexelsCentreStillHasATexel) {
  scene::Mesh speck;
  speck.positions = {Vec3(5, 0, 0), Vec3(5, 0, 0.01f), Vec3(5.01f, 0, 0)};
  speck.normals.assign(3, Vec3(0, 1, 0));
  speck.uvs = {Vec2(0.81f, 0.81f), Vec2(0.81f, 0.812f), Vec2(0.812f, 0.81f)};
  speck.triangles = {{0, 1, 2}};
  scene::Mesh parts[2] = {scene::gridPlane(1, 1, 1, 1), speck};
  for (Vec2& uv : parts[0].uvs) uv *= 0.5f;
  const atlas::Atlas atlas = atlasOf(scene::merge(parts), 16, true);
  ASSERT_TRUE(atlas.ownUvs);
  MesoMesh mesh = scattered(500, 0.0f, 1.0f, 4);
  std::vector<Vec2> q(500, Vec2(0.2f, 0.2f));
  add(mesh, Vec3(5, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0));
  q.emplace_back(0.6f, 0.6f);
  const Result<transfer::IdMap> ids =
      placeIds(atlas, mesh, q, {.size = 16, .patchSize = Vec2(1e4f, 1e4f)}, {});
  ASSERT_TRUE(ids);
  EXPECT_LE(apart(ids->ids[2 * (12 * 16 + 12)], 39322), 2);
  EXPECT_LE(apart(ids->ids[0], 13107), 8);
}

TEST(PlaceIds, RefusesWhatDoesNotFitTogether) {
  const atlas::Atlas plane = atlasOf(scene::gridPlane(1, 1, 1, 1), 8, true);
  const MesoMesh mesh = scattered(10, 0.0f, 1.0f, 5);
  const std::vector<Vec2> q(10, Vec2::Zero());
  const auto kindOf = [&](const Result<transfer::IdMap>& result) {
    EXPECT_FALSE(result);
    return result ? ErrorKind::Failed : result.error().kind;
  };
  EXPECT_EQ(kindOf(placeIds(plane, mesh, q, {.size = 0}, {})), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(placeIds(plane, mesh, q, {.neighbours = 0}, {})), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(placeIds(plane, mesh, q, {.patchSize = Vec2(0, 1)}, {})), ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(placeIds(plane, mesh, std::span(q).first(9), {.size = 8}, {})),
            ErrorKind::BadUsage);
  EXPECT_EQ(kindOf(placeIds(plane, MesoMesh{}, {}, {.size = 8}, {})), ErrorKind::BadInput);
  EXPECT_EQ(
      kindOf(placeIds(plane, mesh, q, {.size = 8}, [](const ProgressUpdate&) { return false; })),
      ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::synthesis
