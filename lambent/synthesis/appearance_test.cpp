#include "lambent/synthesis/appearance.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/synthesis/test_patches.h"
#include "lambent/work/thread_limit.h"

namespace lambent::synthesis {
namespace {

/// The definition: the weighted distance of two places' whole responses.
double squaredDistance(const transfer::SimulatedRtt& rtt, int a, int b) {
  double sum = 0.0, weights = 0.0;
  for (int vy = 0; vy < rtt.views; ++vy) {
    for (int vx = 0; vx < rtt.views; ++vx) {
      const Vec2 u((float(vx) + 0.5f) / float(rtt.views), (float(vy) + 0.5f) / float(rtt.views));
      const double cosine = rtt.views == 1 ? 1.0 : double(math::hemisphereFromSquare(u).z());
      weights += 3 * cosine;
      for (int l = 0; l < rtt.bands; ++l) {
        for (int c = l * l; c < (l + 1) * (l + 1); ++c) {
          const std::size_t i = rtt.index(c, a % rtt.width, a / rtt.width, vx, vy);
          const std::size_t j = rtt.index(c, b % rtt.width, b / rtt.width, vx, vy);
          for (std::size_t k = 0; k < 3; ++k) {
            const double d = double(rtt.values[i + k]) - double(rtt.values[j + k]);
            sum += cosine * d * d / (std::max(l, 1) * std::max(l, 1));
          }
        }
      }
    }
  }
  return sum / weights;
}

double squaredDistance(const Appearance& appearance, int a, int b) {
  double sum = 0.0;
  for (int d = 0; d < appearance.dimensions; ++d) {
    const double x = double(appearance.at(a % appearance.width, a / appearance.width)[d]) -
                     double(appearance.at(b % appearance.width, b / appearance.width)[d]);
    sum += x * x;
  }
  return sum;
}

/// Responses of the rank given, plus a little of everything.
transfer::SimulatedRtt lowRank(int rank, float noise) {
  transfer::SimulatedRtt rtt;
  rtt.width = 16, rtt.height = 12, rtt.views = 3, rtt.bands = 3;
  rtt.values.resize(9 * rtt.planeSize());
  for (int c = 0; c < 9; ++c)
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x)
        for (int v = 0; v < 9; ++v)
          for (int k = 0; k < 3; ++k) {
            const auto place = std::uint64_t(y * 16 + x),
                       column = std::uint64_t((c * 9 + v) * 3 + k);
            float sum = 3.0f + noise * (math::Random(9, place, column).uniform() - 0.5f);
            for (int r = 0; r < rank; ++r) {
              sum += (math::Random(1, place, std::uint64_t(r)).uniform() - 0.5f) *
                     (math::Random(2, column, std::uint64_t(r)).uniform() - 0.5f);
            }
            rtt.values[rtt.index(c, x, y, v % 3, v / 3) + std::size_t(k)] = sum;
          }
  return rtt;
}

TEST(Appearance, DistancesAreThoseOfWholeResponses) {
  const transfer::SimulatedRtt rtt = lowRank(5, 0.0f);
  const Appearance appearance = appearanceOf(rtt, 8);
  EXPECT_NEAR(appearance.keptVariance, 1.0, 1e-4);
  for (int b = 1; b < 190; b += 7) {
    const double wanted = squaredDistance(rtt, 0, b);
    EXPECT_NEAR(squaredDistance(appearance, 0, b), wanted, 1e-3 * wanted + 1e-7);
  }
}

TEST(Appearance, TheMostImportantComponentsAreKept) {
  const transfer::SimulatedRtt rtt = lowRank(6, 0.05f);
  double last = 0.0;
  for (int dimensions : {1, 3, 6, 12}) {
    const Appearance appearance = appearanceOf(rtt, dimensions);
    EXPECT_GT(appearance.keptVariance, last);
    EXPECT_LE(appearance.keptVariance, 1.0);
    last = appearance.keptVariance;
    double kept = 0.0, all = 0.0;
    for (int a = 0; a < 192; a += 5)
      for (int b = 1; b < 192; b += 3) {
        kept += squaredDistance(appearance, a, b), all += squaredDistance(rtt, a, b);
      }
    EXPECT_NEAR(kept / all, appearance.keptVariance, 0.05);
  }
  EXPECT_GT(appearanceOf(rtt, 6).keptVariance, 0.9);
}

TEST(Appearance, APlainPatchLooksAlikeEverywhere) {
  const Appearance appearance =
      appearanceOf(patchOf([](float, float) { return Rgb(0.5f, 0.5f, 0.5f); }, 8), 4);
  for (float v : appearance.values) EXPECT_NEAR(v, 0.0f, 1e-6f);
}

TEST(Appearance, TheSameAtAnyNumberOfThreads) {
  const transfer::SimulatedRtt rtt = patchOf(stuccoAlbedo, 32, 4);
  std::vector<float> values[2];
  for (int i = 0; i < 2; ++i) {
    const work::ThreadLimit threads(1 + 3 * i);
    values[i] = appearanceOf(rtt).values;
  }
  EXPECT_EQ(std::memcmp(values[0].data(), values[1].data(), 4 * values[0].size()), 0);
}

TEST(Regularity, TellsWeavesFromRandomReliefs) {
  EXPECT_GT(regularityOf(appearanceOf(patchOf(weaveAlbedo, 64))), 0.999);
  EXPECT_LT(regularityOf(appearanceOf(patchOf(stuccoAlbedo, 64))), 0.5);
  // One spot in the whole period is met again nowhere.
  const auto spot = [](float u, float v) {
    return Rgb(Rgb::Constant(std::hypot(u - 0.5f, v - 0.5f) < 0.1f ? 1.0f : 0.2f));
  };
  EXPECT_LT(regularityOf(appearanceOf(patchOf(spot, 32))), 0.05);
}

}  // namespace
}  // namespace lambent::synthesis
