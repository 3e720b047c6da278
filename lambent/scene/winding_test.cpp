#include "lambent/scene/winding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/math/random.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"

namespace lambent::scene {
namespace {

/// With a share of the triangles, drawn by lot, wound the wrong way.
Mesh mixed(Mesh mesh, float share) {
  math::Random random(5, 0);
  for (Triangle& t : mesh.triangles)
    if (random.uniform() < share) std::swap(t[1], t[2]);
  return mesh;
}

/// Every triangle with vertices of its own.
Mesh apart(const Mesh& mesh) {
  Mesh out;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      out.positions.push_back(mesh.positions[v]);
      out.normals.push_back(mesh.normals[v]);
    }
    const auto first = std::uint32_t(out.positions.size() - 3);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

std::size_t reversedIn(const Mesh& a, const Mesh& b) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < a.triangles.size(); ++t) count += a.triangles[t] != b.triangles[t];
  return count;
}

/// A strip of `cells` quads around a circle, given `halfTurns` on the way.
Mesh strip(int cells, int halfTurns) {
  Mesh mesh;
  for (int i = 0; i < cells; ++i)
    for (const float side : {-0.3f, 0.3f}) {
      const float angle = 2.0f * float(kPi) * float(i) / float(cells);
      const float turn = 0.5f * angle * float(halfTurns);
      const float radius = 1.0f + side * std::cos(turn);
      mesh.positions.push_back(
          Vec3(radius * std::cos(angle), side * std::sin(turn), radius * std::sin(angle)));
    }
  for (int i = 0; i < cells; ++i) {
    const bool last = i + 1 == cells, crossed = last && halfTurns % 2 == 1;
    const auto a = std::uint32_t(2 * i), c = last ? 0u : a + 2;
    const std::uint32_t near = crossed ? c + 1 : c, far = crossed ? c : c + 1;
    mesh.triangles.push_back({a, a + 1, near});
    mesh.triangles.push_back({a + 1, far, near});
  }
  return mesh;
}

TEST(Winding, AnyShareOfReversedTrianglesIsFoundByTheirNormals) {
  const Mesh right = icosphere(1.0f, 3);
  for (const float share : {0.001f, 0.05f, 0.2f, 0.5f, 0.8f, 0.97f}) {
    Mesh mesh = mixed(right, share);
    const std::size_t wrong = reversedIn(mesh, right);
    EXPECT_EQ(reverseAgainstNormals(mesh, LonePart::OutwardOnly), wrong) << share;
    EXPECT_EQ(topology(mesh).inconsistentEdges, 0u);
    EXPECT_GT(topology(mesh).signedVolume, 4.0);
    mesh = mixed(apart(right), share);
    reverseAgainstNormals(mesh, LonePart::OutwardOnly);
    EXPECT_EQ(topology(mesh).inconsistentEdges, 0u);
    EXPECT_GT(topology(mesh).signedVolume, 4.0);
  }
}

TEST(Winding, NormalsThatAreWrongReverseNothing) {
  Mesh mesh = icosphere(1.0f, 3);
  for (std::size_t v = 0; v < 300; ++v) mesh.normals[v] = -mesh.normals[v];
  EXPECT_EQ(reverseAgainstNormals(mesh, LonePart::Normals), 0u);
}

TEST(Winding, APartByItself) {
  Mesh sheet = flipped(gridPlane(1, 1, 2, 2));
  for (Vec3& n : sheet.normals) n = -n;
  EXPECT_EQ(reverseAgainstNormals(sheet, LonePart::OutwardOnly), 0u);
  EXPECT_EQ(reverseAgainstNormals(sheet, LonePart::Normals), 8u);
  const Mesh parts[] = {icosphere(1, 1), translated(flipped(icosphere(1, 1)), Vec3(3, 0, 0))};
  Mesh two = merge(parts);
  for (std::size_t v = two.normals.size() / 2; v < two.normals.size(); ++v)
    two.normals[v] = -two.normals[v];
  EXPECT_EQ(reverseAgainstNormals(two, LonePart::OutwardOnly), 80u);
  EXPECT_NEAR(topology(two).signedVolume, 2.0 * topology(icosphere(1, 1)).signedVolume, 1e-5);
}

TEST(Winding, WithoutNormalsNeighboursDecide) {
  const Mesh right = icosphere(1.0f, 3), room = flipped(right);
  for (const float share : {0.001f, 0.2f, 0.5f, 0.7f}) {
    Mesh mesh = mixed(right, share);
    mesh.normals.clear();
    reverseAgainstNeighbours(mesh);
    EXPECT_EQ(reversedIn(mesh, right), 0u) << share;
  }
  // A room with a few triangles that are wrong stays a room.
  Mesh mesh = mixed(room, 0.1f);
  reverseAgainstNeighbours(mesh);
  EXPECT_EQ(reversedIn(mesh, room), 0u);
  mesh = room;
  EXPECT_EQ(reverseAgainstNeighbours(mesh), 0u);
  // An open sheet faces as most of it does.
  const Mesh sheet = gridPlane(1, 1, 20, 20);
  mesh = mixed(sheet, 0.3f);
  reverseAgainstNeighbours(mesh);
  EXPECT_EQ(reversedIn(mesh, sheet), 0u);
}

TEST(Winding, OneSidedStripsAreLeft) {
  Mesh band = strip(24, 0), mobius = strip(24, 1);
  std::swap(band.triangles[5][1], band.triangles[5][2]);
  EXPECT_EQ(reverseAgainstNeighbours(band), 1u);
  const Mesh before = mobius;
  EXPECT_EQ(reverseAgainstNeighbours(mobius), 0u);
  EXPECT_EQ(reversedIn(mobius, before), 0u);
  Mesh empty;
  EXPECT_EQ(reverseAgainstNeighbours(empty), 0u);
  EXPECT_EQ(reverseAgainstNormals(empty, LonePart::Normals), 0u);
}

}  // namespace
}  // namespace lambent::scene
