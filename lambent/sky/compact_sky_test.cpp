#include "lambent/sky/compact_sky.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/sky/preetham.h"

namespace lambent::sky {
namespace {

using radiometry::Xyzv;

constexpr CompactBasis kBases[] = {CompactBasis::Cosines, CompactBasis::HarmonicsAbove,
                                   CompactBasis::HarmonicsBlackBelow,
                                   CompactBasis::HarmonicsMirrored};

TEST(CompactSky, ReproducesWhatLiesInItsSpan) {
  const auto cosines = [](const Vec3d& d) {
    const double theta = std::acos(d.y()), phi = std::atan2(d.z(), d.x());
    return Xyzv(
        Xyzv::Constant(3 + std::cos(2 * theta) - .5 * std::cos(4 * theta) * std::cos(2 * phi)));
  };
  EXPECT_LT(errorOf(compactSky(CompactBasis::Cosines, 3, cosines), cosines).rms, 1e-12);
  const auto quadratic = [](const Vec3d& d) {
    return Xyzv(Xyzv::Constant(2 + d.x() + .3 * d.y() - d.x() * d.y() + d.z() * d.z()));
  };
  for (const int n : {3, 4, 5}) {
    EXPECT_LT(errorOf(compactSky(CompactBasis::HarmonicsAbove, n, quadratic), quadratic).rms, 1e-9);
  }
  const auto even = [](const Vec3d& d) {
    return Xyzv(Xyzv::Constant(2 + d.x() + d.y() * d.y() + d.z() * d.z()));
  };
  EXPECT_LT(errorOf(compactSky(CompactBasis::HarmonicsMirrored, 3, even), even).rms, 1e-12);
}

TEST(CompactSky, SkiesGetCloserWithEveryTerm) {
  const PreethamSky preetham = preethamSky(3, .7);
  const SkyColor sky = [&](const Vec3d& d) { return preetham.color(d); };
  for (const CompactBasis basis : kBases) {
    double before = 1;
    for (const int n : {3, 4, 5, 8, 10}) {
      const CompactSkyError error = errorOf(compactSky(basis, n, sky), sky);
      RecordProperty("rms_" + std::to_string(int(basis)) + "_" + std::to_string(n * n),
                     std::to_string(error.rms));
      EXPECT_LT(error.rms, before * 1.0001) << int(basis) << " " << n;
      EXPECT_GE(error.largest, error.rms);
      before = error.rms;
    }
  }
  // Nothing in a span is closer than its least squares.
  for (const int n : {3, 5, 10}) {
    const double best = errorOf(compactSky(CompactBasis::HarmonicsAbove, n, sky), sky).rms;
    EXPECT_LT(best, errorOf(compactSky(CompactBasis::HarmonicsMirrored, n, sky), sky).rms);
    EXPECT_LT(best, errorOf(compactSky(CompactBasis::HarmonicsBlackBelow, n, sky), sky).rms);
  }
}

TEST(CompactSky, BlackSky) {
  const SkyColor black = [](const Vec3d&) { return Xyzv(Xyzv::Zero()); };
  for (const CompactBasis basis : kBases) {
    const CompactSky compact = compactSky(basis, 5, black);
    EXPECT_EQ(compact.coefficients.size(), 25u);
    EXPECT_TRUE(compact.color(Vec3d(0, 1, 0)).isZero());
    EXPECT_EQ(errorOf(compact, black).rms, 0);
  }
}

}  // namespace
}  // namespace lambent::sky
