#include "lambent/synthesis/patch_lay.h"

#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "lambent/scene/shapes.h"

namespace lambent::synthesis {
namespace {

using Tangents = std::vector<Vec3>;

/// Half of a plane of 10 m with the tangent (cos, 0, sin) of an angle everywhere.
struct Half {
  scene::Mesh mesh;
  Tangents tangents;
};
Half half(float x, double degrees) {
  Half made;
  made.mesh = scene::translated(scene::gridPlane(5, 10, 10, 20), Vec3(x, 0, 0));
  for (Vec2& uv : made.mesh.uvs) uv.x() = 0.4f * uv.x() + (x > 0.0f ? 0.55f : 0.05f);
  const double angle = degrees * kPi / 180.0;
  made.tangents.assign(made.mesh.positions.size(),
                       Vec3(float(std::cos(angle)), 0, float(std::sin(angle))));
  return made;
}

PatchLay layOfHalves(double degrees) {
  const Half left = half(-2.5f, 0.0), right = half(2.5f, degrees);
  Tangents tangents = left.tangents;
  tangents.insert(tangents.end(), right.tangents.begin(), right.tangents.end());
  const scene::Mesh parts[] = {left.mesh, right.mesh};
  return patchLay(scene::merge(parts), tangents, 0.5f);
}

TEST(PatchLay, StrokesAreEvenlySpreadAlongThePatch) {
  const scene::Mesh mesh = scene::gridPlane(10, 4, 30, 3);
  const Vec3 along = Vec3(3, 0, 4).normalized();
  const float spacing = strokeSpacing(40.0, 1000);
  const PatchLay lay = patchLay(mesh, Tangents(mesh.positions.size(), along), spacing);
  EXPECT_EQ(lay.turns, 1);
  EXPECT_TRUE(lay.singularities.empty());
  EXPECT_TRUE(lay.cuts.empty());
  EXPECT_NEAR(double(lay.field.size()), 1000.0, 120.0);
  std::size_t left = 0;
  for (std::size_t i = 0; i < lay.field.size(); ++i) {
    const auto& [from, to, normal] = lay.field[i];
    EXPECT_LT(((to - from).normalized() - along).norm(), 1e-4f);
    EXPECT_NEAR((to - from).norm(), 0.7f * spacing, 1e-4f);
    EXPECT_LT((normal - Vec3::UnitY()).norm(), 1e-5f);
    left += from.x() + to.x() < 0.0f;
    for (std::size_t k = 0; k < i; ++k)
      ASSERT_GE((from + to - lay.field[k].from - lay.field[k].to).norm(), 1.999f * spacing);
  }
  EXPECT_NEAR(double(left), 0.5 * double(lay.field.size()), 0.05 * double(lay.field.size()));
}

TEST(PatchLay, CutsLieWhereTextureCoordinatesJump) {
  const PatchLay lay = layOfHalves(0.0);
  ASSERT_EQ(lay.cuts.size(), 20u);
  double length = 0.0;
  for (const auto& [from, to, normal] : lay.cuts) {
    EXPECT_EQ(from.x(), 0.0f);
    EXPECT_EQ(to.x(), 0.0f);
    length += double((to - from).norm());
  }
  EXPECT_NEAR(length, 10.0, 1e-4);
}

TEST(PatchLay, WhatTurnsOverACutAsThePatchDoesIsNoSingularity) {
  for (const auto& [degrees, turns] : {std::pair(0.0, 1), {90.0, 4}, {-90.0, 4}, {180.0, 2}}) {
    const PatchLay lay = layOfHalves(degrees);
    EXPECT_EQ(lay.turns, turns) << degrees;
    EXPECT_TRUE(lay.singularities.empty()) << degrees;
  }
}

TEST(PatchLay, SingularitiesHaveTheIndexOfTheFieldAroundThem) {
  const scene::Mesh mesh = scene::gridPlane(2, 2, 12, 12);
  for (const int index : {-1, 1}) {
    Tangents tangents;
    for (const Vec3& p : mesh.positions) {
      const double angle = index * std::atan2(double(p.z()), double(p.x())) + 0.3;
      tangents.push_back(Vec3(float(std::cos(angle)), 0, float(std::sin(angle))));
    }
    for (const scene::Mesh& each : {mesh, scene::flipped(mesh)}) {
      const PatchLay lay = patchLay(each, tangents, 0.2f);
      ASSERT_EQ(lay.singularities.size(), 1u);
      EXPECT_EQ(lay.singularities[0].index, index);
      EXPECT_LT(lay.singularities[0].position.norm(), 0.2f);
    }
  }
}

}  // namespace
}  // namespace lambent::synthesis
