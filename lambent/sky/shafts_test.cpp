#include "lambent/sky/shafts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "lambent/sky/sun_frame.h"

namespace lambent::sky {
namespace {

/// Thick haze under a Sun at 40°, so that a hundred metres scatter much.
ConstantAir thickHaze() {
  ConstantAir air;
  air.extinction = {2.0e-3, 2.3e-3, 2.8e-3};
  air.air = {0.01, 0.03, 0.08};
  air.aerosol = {2, 1.9, 1.7};
  air.aerosolPhase = media::HenyeyGreenstein{0.6};
  air.sun = sunDirection(0.7);
  return air;
}

/// The shadow of a box between two corners: what sees the Sun past it.
SunVisible pastBox(const Vec3d& lower, const Vec3d& upper, const Vec3d& sun) {
  return [=](const Vec3d& point) {
    double in = 0, out = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(sun[axis]) < 1e-12) {
        if (point[axis] < lower[axis] || point[axis] > upper[axis]) return true;
        continue;
      }
      const double a = (lower[axis] - point[axis]) / sun[axis];
      const double b = (upper[axis] - point[axis]) / sun[axis];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return in >= out;
  };
}

/// Above the path of rays that look along −z; the Sun throws its shadow towards −x and down.
SunVisible box() {
  return pastBox({20, 30, -160}, {60, 70, -60}, thickHaze().sun);
}

/// A view from a metre and a half above the origin.
std::vector<ShaftRay> view(int across, int upwards, double length = 400) {
  std::vector<ShaftRay> rays;
  for (int j = 0; j < upwards; ++j)
    for (int i = 0; i < across; ++i) {
      const Vec3d direction(1.1 * ((i + 0.5) / across - 0.5), 0.7 * ((j + 0.5) / upwards - 0.3),
                            -1);
      rays.push_back({{0, 1.5, 0}, direction.normalized(), length});
    }
  return rays;
}

SamplingPlanes planesOf(int count, int samples = 1) {
  SamplingPlanes planes;
  planes.last = 400;
  planes.count = count;
  planes.samples = samples;
  return planes;
}

Eigen::Array3d unshadowed(const AerialPerspective& air, const ShaftRay& ray) {
  return airBetween(air, ray.direction, ray.length).fromSun;
}

/// Root mean square over a view, of all light.
template <class Shafts>
double errorOver(const std::vector<ShaftRay>& rays, const Shafts& shafts) {
  const ConstantAir air = thickHaze();
  const SunVisible visible = box();
  double sum = 0, all = 0;
  for (const ShaftRay& ray : rays) {
    const Eigen::Array3d truth = shaftsByMarch(air, ray, visible, {4000, 1e-6});
    sum += (shafts(air, ray, visible) - truth).square().sum();
    all += truth.square().sum();
  }
  return std::sqrt(sum / all);
}

TEST(ShaftsByMarch, AgreesWithASumOfManySteps) {
  const ConstantAir air = thickHaze();
  const SunVisible visible = box();
  double shadow = 0;
  for (const ShaftRay& ray : view(9, 5)) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    constexpr int kMany = 20000;
    for (int i = 0; i < kMany; ++i) {
      const double from = ray.length * i / kMany, to = ray.length * (i + 1) / kMany;
      if (visible(ray.origin + 0.5 * (from + to) * ray.direction))
        sum += air.at(ray.direction, to).fromSun - air.at(ray.direction, from).fromSun;
    }
    const Eigen::Array3d marched = shaftsByMarch(air, ray, visible, {1024, 1e-3});
    const Eigen::Array3d all = unshadowed(air, ray);
    EXPECT_LT(((marched - sum) / all).abs().maxCoeff(), 2e-4);
    shadow = std::max(shadow, 1 - marched[1] / all[1]);
  }
  EXPECT_GT(shadow, 0.1);  // the box does throw one
}

TEST(ShaftsByMarch, OneSlabOfShadowInClosedForm) {
  const ConstantAir air = thickHaze();
  const ShaftRay ray{{0, 0, 0}, -Vec3d::UnitZ(), 300};
  const SunVisible visible = [](const Vec3d& p) { return !(p.z() < -50 && p.z() > -120); };
  const auto lit = [&](double t) { return Eigen::Array3d(air.at(ray.direction, t).fromSun); };
  const Eigen::Array3d expected = lit(50) + lit(300) - lit(120);
  EXPECT_LT((shaftsByMarch(air, ray, visible, {16, 1e-9}) / expected - 1).abs().maxCoeff(), 1e-9);
  // Cut where a surface stands within the shadow.
  EXPECT_LT(
      (shaftsByMarch(air, {ray.origin, ray.direction, 100}, visible, {16, 1e-9}) / lit(50) - 1)
          .abs()
          .maxCoeff(),
      1e-9);
}

TEST(Shafts, WithoutShadowAreAllOfTheLight) {
  const ConstantAir air = thickHaze();
  const auto all = [](const Vec3d&) { return true; };
  for (const ShaftRay& ray : view(5, 3)) {
    const Eigen::Array3d expected = unshadowed(air, ray);
    EXPECT_LT((shaftsByMarch(air, ray, all) / expected - 1).abs().maxCoeff(), 1e-12);
    // Exact at any number of planes, evenly spaced or not, and with air before and beyond them.
    for (const int count : {1, 5, 64})
      for (const double rate : {0.0, 2.3e-3}) {
        SamplingPlanes planes = planesOf(count, 2);
        planes.rate = rate;
        planes.first = 20;
        planes.last = 250;
        EXPECT_LT((shaftsBySplitPlanes(air, ray, all, planes) / expected - 1).abs().maxCoeff(),
                  1e-12);
      }
    // The sum of 2000 is a rule of midpoints.
    const auto off = [&](int count) {
      return (shaftsByPlanes(air, ray, all, planesOf(count)) / expected - 1).abs().maxCoeff();
    };
    EXPECT_LT(off(16), 4e-4);
    EXPECT_LT(off(64), off(16) / 12);
  }
}

TEST(Shafts, NothingIsLitInTheDark) {
  const ConstantAir air = thickHaze();
  const auto none = [](const Vec3d&) { return false; };
  const ShaftRay ray = view(1, 1).front();
  EXPECT_TRUE((shaftsByMarch(air, ray, none) == 0).all());
  EXPECT_LT(shaftsByPlanes(air, ray, none, planesOf(8)).abs().maxCoeff(),
            0.02 * unshadowed(air, ray)[0]);
  SamplingPlanes planes = planesOf(8);
  planes.last = 1e4;
  EXPECT_LT(shaftsBySplitPlanes(air, ray, none, planes).abs().maxCoeff(), 1e-12);
}

TEST(Shafts, OfABoxConverge) {
  const std::vector<ShaftRay> rays = view(24, 10);
  double before2000 = 1, before2002 = 1;
  for (const int count : {8, 32, 128, 512}) {
    const double of2000 = errorOver(
        rays, [&](const ConstantAir& air, const ShaftRay& ray, const SunVisible& visible) {
          return shaftsByPlanes(air, ray, visible, planesOf(count));
        });
    const double of2002 = errorOver(
        rays, [&](const ConstantAir& air, const ShaftRay& ray, const SunVisible& visible) {
          return shaftsBySplitPlanes(air, ray, visible, planesOf(count));
        });
    if (std::getenv("LAMBENT_TEST_VERBOSE"))
      std::printf("%d planes: 2000 %.3f%%, 2002 %.3f%%\n", count, 100 * of2000, 100 * of2002);
    EXPECT_LT(of2000, before2000 / 2.5) << count;
    EXPECT_LT(of2002, before2002 / 2.5) << count;
    before2000 = of2000;
    before2002 = of2002;
  }
  EXPECT_LT(before2000, 1e-3);
  EXPECT_LT(before2002, 1e-3);
}

TEST(Shafts, SamplesBetweenPlanesAreWorthPlanes) {
  const std::vector<ShaftRay> rays = view(24, 10);
  const auto split = [&](int count, int samples) {
    return errorOver(rays,
                     [&](const ConstantAir& air, const ShaftRay& ray, const SunVisible& visible) {
                       return shaftsBySplitPlanes(air, ray, visible, planesOf(count, samples));
                     });
  };
  EXPECT_LT(split(16, 8), 1.3 * split(128, 1));
  EXPECT_LT(split(16, 8), split(16, 1) / 3);
}

TEST(Shafts, BandsAreNoLargerThanStated) {
  const ConstantAir air = thickHaze();
  const ShaftRay ray{{0, 0, 0}, -Vec3d::UnitZ(), 400};
  for (const double rate : {0.0, 2.3e-3}) {
    SamplingPlanes planes = planesOf(32, 2);
    planes.rate = rate;
    const Eigen::Array3d bound = largestStep(air, ray, planes);
    // An edge of a shadow moves along the ray.
    Eigen::Array3d before = Eigen::Array3d::Zero(), largest = before;
    for (double edge = 0; edge < 400; edge += 0.05) {
      const Eigen::Array3d now = shaftsBySplitPlanes(
          air, ray, [edge](const Vec3d& p) { return -p.z() < edge; }, planes);
      largest = largest.max((now - before).abs());
      before = now;
    }
    EXPECT_TRUE((largest <= bound * (1 + 1e-9)).all());
    EXPECT_TRUE((largest >= bound * (1 - 1e-9)).all());
    // Of 32 planes with 2 samples: never more than a 64th of the light but for extinction.
    const Eigen::Array3d mean = unshadowed(air, ray) / 64;
    EXPECT_TRUE((bound < mean * (rate > 0 ? 1.13 : 1.75)).all()) << (bound / mean).transpose();
  }
}

TEST(Shafts, AShadowTakesAwayAndNeverMore) {
  const ConstantAir air = thickHaze();
  const SunVisible visible = box();
  for (const ShaftRay& ray : view(7, 4)) {
    const Eigen::Array3d all = unshadowed(air, ray);
    for (const Eigen::Array3d& lit :
         {shaftsByMarch(air, ray, visible), shaftsBySplitPlanes(air, ray, visible, planesOf(24))}) {
      EXPECT_TRUE((lit >= 0).all());
      EXPECT_TRUE((lit <= all * (1 + 1e-12)).all());
    }
  }
}

/// The air of an atmosphere, of light scattered once.
const Scattering& scatteredOnce() {
  static const Scattering solved = [] {
    std::vector<double> nm;
    for (int i = 0; i < 16; ++i) nm.push_back(380 + 24 * i);
    Resolution once;
    once.orders = 1;
    once.sunFrom = once.sunTo = kPi / 2 - 0.35;
    return *Scattering::solve(mediumOf(*preset("hazy"), nm), once);
  }();
  return solved;
}

TEST(Shafts, OfATableAreThoseOfTheIntegral) {
  const ViewerInAir viewer{50, 0.35};
  const AerialPerspective exact = ExactAir(scatteredOnce(), *preset("hazy"), viewer);
  const AerialPerspective table = AirTable(scatteredOnce(), *preset("hazy"), viewer);
  // Shadows of mountains, kilometres long, in the air of a valley.
  const Vec3d sun = sunDirection(viewer.sunElevation);
  const SunVisible mountain = pastBox({3000, -500, -9000}, {5000, 2500, -4000}, sun);
  double worst = 0, shadow = 0;
  for (const ShaftRay& narrow : view(8, 4)) {
    const ShaftRay ray{narrow.origin, narrow.direction, 20e3};
    SamplingPlanes planes;
    planes.last = 20e3;
    planes.count = 64;
    planes.samples = 2;
    const Eigen::Array3d truth = shaftsByMarch(exact, ray, mountain, {256, 1});
    const Eigen::Array3d ours = shaftsBySplitPlanes(table, ray, mountain, planes);
    const Eigen::Array3d all = unshadowed(exact, ray);
    worst = std::max(worst, ((ours - truth) / all).abs().maxCoeff());
    shadow = std::max(shadow, 1 - truth[1] / all[1]);
  }
  if (std::getenv("LAMBENT_TEST_VERBOSE"))
    std::printf("table against integral: worst %.3f%% of unshadowed, shadow up to %.0f%%\n",
                100 * worst, 100 * shadow);
  EXPECT_LT(worst, 0.02);
  EXPECT_GT(shadow, 0.1);
}

}  // namespace
}  // namespace lambent::sky
