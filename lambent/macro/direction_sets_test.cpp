#include "lambent/macro/direction_sets.h"

#include <gtest/gtest.h>

#include <set>

#include "lambent/math/random.h"

namespace lambent::macro {
namespace {

scene::Box cube(float side) {
  scene::Box box;
  box.extend(Vec3::Constant(-0.5f * side));
  box.extend(Vec3::Constant(0.5f * side));
  return box;
}

TEST(DirectionSets, AreTheSameLatticeTurnedAndFewerWhereTheyAreLarge) {
  const DirectionSets few(512, 3, cube(1)), many(65536, 3, cube(1));
  EXPECT_EQ(few.count(), 8u);
  EXPECT_EQ(many.count(), 1u);
  for (std::size_t k = 0; k < few.count(); ++k) {
    EXPECT_EQ(few[k].size(), 512u);
    EXPECT_EQ(few[k].weight(), few[0].weight());
    for (std::size_t j = 0; j < k; ++j) EXPECT_NE(few[k][0], few[j][0]);
  }
}

TEST(DirectionSets, NeighboursTakeDifferentOnes) {
  const DirectionSets sets(2048, 0, cube(2));
  std::set<std::size_t> taken;
  int same = 0, count = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 here(0.004f * float(k) - 0.8f, 0, 0.3f), there = here + Vec3(0.004f, 0, 0);
    taken.insert(sets.numberAt(here));
    same += sets.numberAt(here) == sets.numberAt(there), ++count;
  }
  EXPECT_EQ(taken.size(), sets.count());
  EXPECT_LT(same, count / 4);  // an eighth, by chance
}

// Whatever the file rounds, and whatever stands farther away.
TEST(DirectionSets, APlaceHasItsOwn) {
  const DirectionSets sets(2048, 5, cube(2)), larger(2048, 5, cube(2.2f)), other(2048, 6, cube(2));
  int same = 0, sameInOther = 0;
  math::Random random(1, 0);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
    EXPECT_EQ(sets.numberAt(p), larger.numberAt(p));
    same += sets.numberAt(p) == sets.numberAt(p + Vec3::Constant(1e-7f));
    sameInOther += sets.numberAt(p) == other.numberAt(p);
  }
  EXPECT_GE(same, 995);
  EXPECT_LT(sameInOther, 250);
  for (const float x : {0.0f, 0.5f, 1.0f, -1.0f})
    EXPECT_EQ(sets.numberAt(Vec3(x, 0, x)),
              sets.numberAt(Vec3(std::nextafter(x, 2.0f), -0.0f, std::nextafter(x, -2.0f))));
}

}  // namespace
}  // namespace lambent::macro
