#include "lambent/synthesis/patch_symmetry.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "lambent/synthesis/test_patches.h"

namespace lambent::synthesis {
namespace {

/// Whether t is a sum of whole multiples of the lattice's vectors.
bool isIn(const PatchSymmetry& symmetry, const Vec2& t) {
  Eigen::Matrix2f basis;
  basis << symmetry.lattice[0], symmetry.lattice[1];
  const Vec2 times = basis.inverse() * t;
  return (times - Vec2(std::round(times.x()), std::round(times.y()))).norm() < 1e-3f;
}

/// A patch lit alike from all sides: band 1 answers to light from above alone.
template <class Albedo>
transfer::SimulatedRtt uprightPatch(const Albedo& albedo, int side) {
  transfer::SimulatedRtt rtt = patchOf(albedo, side, 2);
  for (const int c : {1, 3})
    std::fill_n(rtt.values.begin() + std::ptrdiff_t(std::size_t(c) * rtt.planeSize()),
                rtt.planeSize(), 0.0f);
  return rtt;
}

Rgb greyWeave(float u, float v) {
  return Rgb::Constant(weaveAlbedo(u, v).mean());
}

TEST(PatchSymmetry, AWeaveRepeatsItsThreadsAndTurnsByQuartersBetweenThem) {
  const PatchSymmetry found = symmetryOf(uprightPatch(greyWeave, 48));
  EXPECT_EQ(found.cells(), 8);
  EXPECT_TRUE(isIn(found, Vec2(0.25f, 0.25f)));
  EXPECT_TRUE(isIn(found, Vec2(0.5f, 0.0f)));
  EXPECT_FALSE(isIn(found, Vec2(0.25f, 0.0f)));
  EXPECT_EQ(found.turns, 4);
  // Where four threads meet: whole multiples of a quarter.
  const Vec2 threads = 4.0f * found.centre;
  EXPECT_LT((threads - Vec2(std::round(threads.x()), std::round(threads.y()))).norm(), 0.02f);
}

TEST(PatchSymmetry, OfTwoColoursTurnsByHalvesAlone) {
  const PatchSymmetry found = symmetryOf(uprightPatch(weaveAlbedo, 48));
  EXPECT_EQ(found.cells(), 8);
  EXPECT_EQ(found.turns, 2);
}

TEST(PatchSymmetry, ItsLightTurnsWithIt) {
  // All of it leans to one side.
  EXPECT_EQ(symmetryOf(patchOf(greyWeave, 48)).turns, 1);
}

TEST(PatchSymmetry, RandomReliefHasNone) {
  const PatchSymmetry found = symmetryOf(uprightPatch(stuccoAlbedo, 48));
  EXPECT_EQ(found.cells(), 1);
  EXPECT_EQ(found.turns, 1);
  EXPECT_LT(found.moved, 0.5);
}

TEST(PatchSymmetry, APeriodOfThreeFitsNoTexels) {
  const auto dots = [](float u, float v) {
    const float x = 3 * u - std::floor(3 * u) - 0.5f, y = 2 * v - std::floor(2 * v) - 0.5f;
    return Rgb(Rgb::Constant(std::exp(-12.0f * (x * x + 0.5f * y * y))));
  };
  const PatchSymmetry found = symmetryOf(uprightPatch(dots, 32));
  EXPECT_EQ(found.cells(), 6);
  EXPECT_TRUE(isIn(found, Vec2(1.0f / 3.0f, 0.0f)));
  EXPECT_TRUE(isIn(found, Vec2(0.0f, 0.5f)));
}

}  // namespace
}  // namespace lambent::synthesis
