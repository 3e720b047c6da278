#include "lambent/synthesis/lattice_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lambent/scene/shapes.h"
#include "lambent/synthesis/tangent_field.h"
#include "lambent/work/thread_limit.h"

namespace lambent::synthesis {
namespace {

PatchSymmetry symmetryOfTurns(int turns) {
  PatchSymmetry symmetry;
  symmetry.turns = turns;
  symmetry.lattice = {Vec2(0.25f, 0.25f), Vec2(-0.25f, 0.25f)};  // of a plain weave
  symmetry.centre = Vec2(0.25f, 0.5f);
  return symmetry;
}

struct Laid {
  CrossField field;
  LatticeMap map;
};

Laid laid(const scene::Mesh& mesh, int turns, float patch, std::optional<Vec3> direction = {}) {
  TangentFieldOptions options;
  options.turns = turns;
  options.direction = direction;
  const auto combed = tangentField(mesh, options);
  const Manifold manifold = manifoldOf(mesh);
  Laid out;
  out.field = crossField(mesh, manifold, combed->value.tangents, turns);
  const std::vector<std::uint32_t> charts(mesh.triangles.size(), 0);
  comb(manifold, charts, out.field);
  auto map =
      latticeMap(manifold, out.field, charts, symmetryOfTurns(turns), Vec2(patch, patch), {});
  if (!map) ADD_FAILURE() << map.error().message;
  if (map) out.map = std::move(*map);
  return out;
}

int indexSum(const CrossField& field) {
  int sum = 0;
  for (const auto& s : field.singularities) sum += s.index;
  return sum;
}

TEST(CrossField, IndicesSumToTheEulerCharacteristic) {
  for (const int turns : {1, 2, 4}) {
    EXPECT_EQ(indexSum(laid(scene::icosphere(1.0f, 4), turns, 0.4f).field), 2 * turns);
    EXPECT_EQ(indexSum(laid(scene::flipped(scene::icosphere(1.0f, 4)), turns, 0.4f).field),
              2 * turns);
    EXPECT_EQ(indexSum(laid(scene::torus(1.0f, 0.4f, 60, 30), turns, 0.4f).field), 0);
    EXPECT_EQ(indexSum(laid(scene::box(Vec3(1, 2, 3), 8), turns, 0.4f).field), 2 * turns);
  }
}

TEST(CrossField, SingularitiesOfACrossAreSpread) {
  const scene::Mesh mesh = scene::icosphere(1.0f, 4);
  const Manifold manifold = manifoldOf(mesh);
  const CrossField field = laid(mesh, 4, 0.4f).field;
  ASSERT_EQ(field.singularities.size(), 8u);
  std::vector<Vec3> at;
  for (const auto& s : field.singularities) {
    EXPECT_EQ(s.index, 1);
    const std::uint32_t corner = manifold.firstCorner[s.vertex];
    at.push_back(mesh.positions[mesh.triangles[corner / 3][corner % 3]]);
  }
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((at[i] - at[j]).norm(), 0.8f);
}

TEST(LatticeMap, GoesOnOverEveryEdge) {
  for (const int turns : {1, 2, 4}) {
    for (const scene::Mesh& mesh :
         {scene::icosphere(1.0f, 4), scene::torus(1.0f, 0.4f, 60, 30), scene::box(Vec3(1, 2, 3), 8),
          scene::gridPlane(3.0f, 1.0f, 30, 10), scene::ring(0.5f, 1.0f, 0.3f, 40, 4),
          scene::flipped(scene::icosphere(1.0f, 3))}) {
      const LatticeMap map = laid(mesh, turns, 0.4f).map;
      EXPECT_EQ(map.continued, map.edges);
      EXPECT_GT(map.edges, mesh.triangles.size());
      EXPECT_EQ(map.flipped, 0.0);
    }
  }
}

/// The number of quarter turns and lattice vectors that an edge's places differ by says nothing of
/// how large the patch is: that is held here.
TEST(LatticeMap, KeepsItsSizeWhereTheSurfaceLetsIt) {
  const LatticeMap plane = laid(scene::gridPlane(3.0f, 1.0f, 30, 10), 4, 0.4f).map;
  EXPECT_LT(plane.stretch, 1e-3);
  const LatticeMap sphere = laid(scene::icosphere(1.0f, 4), 4, 0.4f).map;
  EXPECT_LT(sphere.stretch, 0.12);
  EXPECT_LT(sphere.squeezed, 0.03);
  const LatticeMap box = laid(scene::box(Vec3(1, 2, 3), 8), 4, 0.4f).map;
  EXPECT_LT(box.stretch, 0.05);
}

TEST(LatticeMap, AClosedBandHoldsAWholeNumberOfCells) {
  // 2π · 0.5 around: not a whole number of cells of 0.1 m in a row.
  const scene::Mesh band = scene::cylinder(0.5f, 0.6f, 64, 12);
  const LatticeMap map = laid(band, 4, 0.4f, Vec3(0, 1, 0)).map;
  EXPECT_EQ(map.continued, map.edges);
  EXPECT_LT(map.stretch, 0.05);
}

TEST(LatticeMap, FollowsADirection) {
  const scene::Mesh plane = scene::gridPlane(3.0f, 1.0f, 30, 10);
  const Vec3 direction = Vec3(1.0f, 0.0f, 0.4f).normalized();
  for (const int turns : {1, 2, 4}) {
    const LatticeMap map = laid(plane, turns, 0.4f, direction).map;
    for (const Vec3& tangent : map.tangents) {
      const float along = std::abs(tangent.dot(direction));
      EXPECT_NEAR(turns == 4 ? std::max(along, std::sqrt(1 - along * along)) : along, 1.0f, 1e-3f);
    }
  }
}

TEST(LatticeMap, MirroredNormalsKeepThePatchReadable) {
  // Whoever looks along the normal from outside sees +y to the left of +x.
  for (const bool flip : {false, true}) {
    scene::Mesh sphere = scene::icosphere(1.0f, 3);
    if (flip)
      for (scene::Triangle& t : sphere.triangles) std::swap(t[1], t[2]);  // normals stay
    const LatticeMap map = laid(sphere, 4, 0.4f).map;
    for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
      const auto& [a, b, c] = sphere.triangles[t];
      Eigen::Matrix2f sides;
      const Vec3 normal = sphere.normals[a], x = map.tangents[t], y = normal.cross(x);
      const Vec3 e = sphere.positions[b] - sphere.positions[a],
                 f = sphere.positions[c] - sphere.positions[a];
      sides << e.dot(x), f.dot(x), e.dot(y), f.dot(y);
      Eigen::Matrix2f places;
      places << map.places[3 * t + 1] - map.places[3 * t],
          map.places[3 * t + 2] - map.places[3 * t];
      const Eigen::Matrix2f grows = 0.4f * places * sides.inverse();
      EXPECT_GT(grows(0, 0), 0.5f);
      EXPECT_GT(grows(1, 1), 0.5f);
    }
  }
}

TEST(LatticeMap, TheSameAtAnyNumberOfThreads) {
  const scene::Mesh mesh = scene::torus(1.0f, 0.4f, 40, 20);
  const LatticeMap many = laid(mesh, 4, 0.4f).map;
  const work::ThreadLimit one(1);
  const LatticeMap few = laid(mesh, 4, 0.4f).map;
  EXPECT_EQ(many.places, few.places);
  EXPECT_EQ(many.tangents, few.tangents);
}

}  // namespace
}  // namespace lambent::synthesis
