#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "lambent/math/directions.h"
#include "lambent/math/min_cut.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/math/statistics.h"
#include "lambent/math/union_find.h"

namespace lambent::math {
namespace {

TEST(Quadrature, IntegratesEveryPolynomialItShould) {
  for (int n : {1, 2, 3, 5, 16, 33, 64}) {
    const Quadrature rule = gaussLegendre(n);
    for (int degree = 0; degree <= 2 * n - 1; ++degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      EXPECT_NEAR(sum, degree % 2 ? 0 : 2.0 / (degree + 1), 2e-14) << n << " " << degree;
    }
  }
}

TEST(Quadrature, NodesRiseInsideTheInterval) {
  const Quadrature rule = gaussLegendre(1000, 2, 5);
  double sum = 0, last = 2;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_GT(rule.nodes[i], last);
    last = rule.nodes[i];
    sum += rule.weights[i] * std::exp(rule.nodes[i]);
  }
  EXPECT_LT(last, 5);
  EXPECT_NEAR(sum, std::exp(5) - std::exp(2), 1e-11);
}

TEST(Random, DependsOnTheWholeKeyAndNothingElse) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (std::uint64_t stream = 0; stream < 20; ++stream)
      for (std::uint64_t sub = 0; sub < 20; ++sub) first.insert(Random(seed, stream, sub).bits());
  EXPECT_EQ(first.size(), 8000u);
  Random a(1, 2, 3), b(1, 2, 3);
  a.uniform();
  b.uniform();
  EXPECT_EQ(a.bits(), b.bits());
}

TEST(Random, IsUniformAcrossKeysAndAlongOne) {
  RunningMoments along, across, product;
  Random one(7, 0);
  for (int i = 0; i < 100000; ++i) {
    along.add(one.uniform());
    Random fresh(7, i, 0);
    const Vec2 u = fresh.uniform2();
    across.add(u.x());
    product.add(u.x() * u.y());
  }
  for (const RunningMoments* m : {&along, &across}) {
    EXPECT_LT(std::abs(m->mean() - 0.5), 4 * m->standardError());
    EXPECT_NEAR(m->variance(), 1.0 / 12, 1e-3);
  }
  EXPECT_LT(std::abs(product.mean() - 0.25), 4 * product.standardError());
  EXPECT_LT(unitFloat(~std::uint64_t(0)), 1.0f);
}

TEST(Random, RotationsAreUniformOnSO3) {
  // Uniform: every column is uniform on the sphere, and the trace has the moments E[tr]=0,
  // E[tr²]=1 (the three-dimensional representation is irreducible).
  RunningMoments trace, traceSquared, z;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    const Mat3d q = randomRotationDouble(seed);
    ASSERT_LT((q.transpose() * q - Mat3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
    ASSERT_NEAR(q.determinant(), 1, 1e-14);
    trace.add(q.trace());
    traceSquared.add(q.trace() * q.trace());
    z.add(q(2, 2) * q(2, 2));
  }
  EXPECT_LT(std::abs(trace.mean()), 4 * trace.standardError());
  EXPECT_LT(std::abs(traceSquared.mean() - 1), 4 * traceSquared.standardError());
  EXPECT_LT(std::abs(z.mean() - 1.0 / 3), 4 * z.standardError());
  EXPECT_EQ(randomRotation(5), randomRotation(5));
  EXPECT_NE(randomRotation(5), randomRotation(6));
}

TEST(Sequences, FibonacciDirectionsAreUnitAndBalanced) {
  const std::vector<Vec3> directions = sphericalFibonacci(4096);
  ASSERT_EQ(directions.size(), 4096u);
  Vec3d first = Vec3d::Zero();
  Mat3d second = Mat3d::Zero();
  for (const Vec3& d : directions) {
    EXPECT_NEAR(d.norm(), 1, 1e-6);
    first += d.cast<double>();
    second += d.cast<double>() * d.cast<double>().transpose();
  }
  EXPECT_LT(first.norm() / 4096, 1e-4);
  EXPECT_LT((second / 4096 - Mat3d::Identity() / 3).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_TRUE(sphericalFibonacci(0).empty());
}

TEST(Sequences, ScrambledSobolFillsEveryElementaryInterval) {
  for (std::uint32_t seed : {0u, 1u, 77u}) {
    for (int log = 0; log <= 8; ++log) {
      std::set<int> cells;
      const int columns = 1 << log, rows = 256 / columns;
      for (std::uint32_t i = 0; i < 256; ++i) {
        const Vec2 p = sobol2(i, seed);
        ASSERT_TRUE(p.x() >= 0 && p.x() < 1 && p.y() >= 0 && p.y() < 1);
        cells.insert(int(p.x() * columns) * rows + int(p.y() * rows));
      }
      EXPECT_EQ(cells.size(), 256u) << seed << " " << columns << "x" << rows;
    }
  }
  EXPECT_NE(sobol2(0, 1), sobol2(0, 2));
}

TEST(Sequences, R2AndRadicalInverseCoverTheUnitInterval) {
  RunningMoments x, y;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Vec2 p = r2(i);
    ASSERT_TRUE(p.minCoeff() >= 0 && p.maxCoeff() < 1);
    x.add(p.x());
    y.add(p.y());
  }
  EXPECT_NEAR(x.mean(), 0.5, 2e-3);
  EXPECT_NEAR(y.mean(), 0.5, 2e-3);
  EXPECT_DOUBLE_EQ(radicalInverse(2, 6), 0.375);
  EXPECT_DOUBLE_EQ(radicalInverse(3, 5), 2.0 / 3 + 1.0 / 9);
}

TEST(Directions, FramesAreRightHandedForEveryNormal) {
  std::vector<Vec3> normals = sphericalFibonacci(1000);
  for (int axis = 0; axis < 3; ++axis)
    for (float sign : {-1.0f, 1.0f}) normals.push_back(sign * Vec3::Unit(axis));
  normals.push_back(Vec3(1, 0, -0.0f));
  for (const Vec3& n : normals) {
    const Mat3 frame = worldFromTangent(n);
    EXPECT_EQ(Vec3(frame * Vec3::UnitZ()), n);
    EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-6f);
    EXPECT_NEAR(frame.determinant(), 1, 1e-6);
  }
}

// A warp and its density agree when the mean of f/pdf is the integral of f. f = z² · [domain].
TEST(Directions, WarpsFollowTheirDensities) {
  const auto integrate = [](auto&& warp, auto&& pdf) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 16384; ++i) {
      const Vec3 d = warp(sobol2(i, 3));
      EXPECT_NEAR(d.norm(), 1, 1e-5);
      const float p = pdf(d.z());
      if (p > 0) sum += d.z() * d.z() / p;
    }
    return sum / 16384;
  };
  const auto moment = [](double c) { return 2 * kPi * (1 - c * c * c) / 3; };  // ∫ z² for z > c
  EXPECT_NEAR(integrate(uniformSphere, [](float) { return uniformSpherePdf(); }), moment(-1), 1e-3);
  EXPECT_NEAR(integrate(uniformHemisphere, uniformHemispherePdf), moment(0), 1e-3);
  EXPECT_NEAR(integrate(cosineHemisphere, cosineHemispherePdf), moment(0), 1e-3);
  EXPECT_NEAR(integrate([](const Vec2& u) { return phongLobe(u, 1.5f); },
                        [](float c) { return phongLobePdf(c, 1.5f); }),
              moment(0), 1e-3);
  EXPECT_NEAR(integrate([](const Vec2& u) { return uniformCone(u, 0.75f); },
                        [](float c) { return uniformConePdf(c, 0.75f); }),
              moment(0.75), 1e-3);
}

TEST(Directions, ConcentricDiscPreservesArea) {
  // The radius of a uniform disc has the distribution r²: its mean is 2/3.
  double radius = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) radius += concentricDisc(sobol2(i, 0)).norm();
  EXPECT_NEAR(radius / 4096, 2.0 / 3, 1e-3);
  EXPECT_LE(concentricDisc(Vec2(0, 0)).norm(), 1 + 1e-6f);
}

TEST(Directions, ReflectionPointsAwayFromTheSurface) {
  const Vec3 n = Vec3(1, 2, 3).normalized(), out = Vec3(0.5f, -0.1f, 2).normalized();
  const Vec3 mirrored = reflectAbout(out, n);
  EXPECT_NEAR(mirrored.dot(n), out.dot(n), 1e-6);
  EXPECT_NEAR((mirrored + out).normalized().dot(n), 1, 1e-6);
}

TEST(Directions, AzimuthRunsFromXTowardsZAndElevationUpToY) {
  EXPECT_TRUE(directionFromAzimuthElevation(0, 0).isApprox(Vec3d::UnitX(), 1e-15));
  EXPECT_TRUE(directionFromAzimuthElevation(kPi / 2, 0).isApprox(Vec3d::UnitZ(), 1e-15));
  EXPECT_TRUE(directionFromAzimuthElevation(1.0, kPi / 2).isApprox(Vec3d::UnitY(), 1e-15));
  const double half = std::sqrt(0.5);
  EXPECT_TRUE(directionFromAzimuthElevation(kPi, -kPi / 4).isApprox(Vec3d(-half, -half, 0), 1e-15));
  Random random(8, 2);
  for (int i = 0; i < 1000; ++i) {
    const double azimuth = 2 * kPi * (random.uniform() - 0.5);
    // Near to a pole too, where the sine of the elevation is 1 in every digit.
    const double fromPole = kPi * std::pow(10.0, -9.0 * random.uniform());
    const double elevation = i % 2 ? kPi / 2 - fromPole : fromPole - kPi / 2;
    const Vec3d direction = directionFromAzimuthElevation(azimuth, elevation);
    EXPECT_NEAR(direction.norm(), 1, 1e-15);
    const auto back = azimuthElevationOf(Vec3d(3 * direction));
    EXPECT_NEAR(back.elevation, elevation, 1e-15);
    EXPECT_NEAR(back.azimuth, azimuth, 1e-14 + 1e-15 / fromPole);
    EXPECT_NEAR(azimuthElevationOf(Vec3(direction.cast<float>())).elevation, elevation, 1e-6);
  }
}

TEST(Statistics, RunsMergeToTheWhole) {
  RunningMoments whole, left, right;
  Random random(1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double x = 5 + random.uniform();
    whole.add(x);
    (i < 300 ? left : right).add(x);
  }
  left.merge(right);
  EXPECT_EQ(left.count(), whole.count());
  EXPECT_NEAR(left.mean(), whole.mean(), 1e-12);
  EXPECT_NEAR(left.variance(), whole.variance(), 1e-12);
}

TEST(UnionFind, ARootIsTheSmallestOfItsSet) {
  UnionFind sets(6);
  sets.join(5, 3), sets.join(4, 2), sets.join(3, 4);
  for (const std::uint32_t i : {2u, 3u, 4u, 5u}) EXPECT_EQ(sets.rootOf(i), 2u);
  for (const std::uint32_t i : {0u, 1u}) EXPECT_EQ(sets.rootOf(i), i);
}

/// What a choice of sides costs, by the definition.
double costOf(std::uint32_t firsts, const std::vector<std::array<double, 2>>& nodes,
              const std::vector<std::array<std::uint32_t, 2>>& links,
              const std::vector<std::array<double, 2>>& costs) {
  double sum = 0.0;
  const auto isFirst = [&](std::uint32_t v) { return (firsts >> v & 1) != 0; };
  for (std::uint32_t v = 0; v < nodes.size(); ++v) sum += nodes[v][isFirst(v) ? 0 : 1];
  for (std::size_t k = 0; k < links.size(); ++k) {
    const bool a = isFirst(links[k][0]), b = isFirst(links[k][1]);
    if (a != b) sum += costs[k][a ? 0 : 1];
  }
  return sum;
}

TEST(MinCut, FindsTheLeastOfAllWaysToPartAGraph) {
  constexpr std::uint32_t kNodes = 9;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    Random random(7, trial);
    std::vector<std::array<double, 2>> nodes, costs;
    std::vector<std::array<std::uint32_t, 2>> links;
    MinCut cut(kNodes);
    for (std::uint32_t v = 0; v < kNodes; ++v) {
      nodes.push_back({random.uniformDouble(), random.uniformDouble()});
      // In two parts: what is added adds up.
      cut.addNode(v, nodes[v][0] - 0.1 * nodes[v][0], 0.0);
      cut.addNode(v, 0.1 * nodes[v][0], nodes[v][1]);
    }
    for (std::uint32_t k = 0; k < 16; ++k) {
      const std::uint32_t a = random.below(kNodes), b = random.below(kNodes);
      if (a == b) continue;
      links.push_back({a, b});
      costs.push_back({0.5 * random.uniformDouble(), k % 4 == 0 ? 0.0 : random.uniformDouble()});
      cut.addLink(a, b, costs.back()[0], costs.back()[1]);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t firsts = 0; firsts < 1u << kNodes; ++firsts)
      least = std::min(least, costOf(firsts, nodes, links, costs));
    ASSERT_NEAR(cut.solve(), least, 1e-12);
    std::uint32_t chosen = 0;
    for (std::uint32_t v = 0; v < kNodes; ++v) chosen |= std::uint32_t(cut.isOnFirst(v)) << v;
    ASSERT_NEAR(costOf(chosen, nodes, links, costs), least, 1e-12);
  }
}

TEST(MinCut, RunsThroughTheGapOfAWall) {
  // A grid with a wall of dear links and one column of cheap ones; its left wants the first side.
  constexpr std::uint32_t kWide = 60, kHigh = 40, kGap = 37;
  MinCut cut(kWide * kHigh);
  for (std::uint32_t y = 0; y < kHigh; ++y)
    for (std::uint32_t x = 0; x < kWide; ++x) {
      const std::uint32_t v = y * kWide + x;
      if (x == 0) cut.addNode(v, 0.0, 1000.0);
      if (x + 1 == kWide) cut.addNode(v, 1000.0, 0.0);
      const double cost = x == kGap ? 0.25 : 1.0;
      if (x + 1 < kWide) cut.addLink(v, v + 1, cost, cost);
      if (y + 1 < kHigh) cut.addLink(v, v + kWide, 1.0, 1.0);
    }
  EXPECT_NEAR(cut.solve(), 0.25 * kHigh, 1e-9);
  for (std::uint32_t v = 0; v < kWide * kHigh; ++v)
    ASSERT_EQ(cut.isOnFirst(v), v % kWide <= kGap) << v;
}

TEST(MinCut, WhatIsNoCostCountsAsNone) {
  MinCut cut(2);
  cut.addNode(0, std::numeric_limits<double>::quiet_NaN(), 2.0);
  cut.addNode(1, 1.0, -3.0);
  cut.addLink(0, 1, std::numeric_limits<double>::quiet_NaN(), -1.0);
  EXPECT_EQ(cut.solve(), 0.0);
  EXPECT_TRUE(cut.isOnFirst(0));
  EXPECT_FALSE(cut.isOnFirst(1));
}

}  // namespace
}  // namespace lambent::math
