#include "lambent/synthesis/meso_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/scene/shapes.h"
#include "lambent/work/thread_limit.h"

namespace lambent::synthesis {
namespace {

MesoMesh mesoOf(const scene::Mesh& mesh, MesoMeshOptions options) {
  const auto field = tangentField(mesh, {});
  EXPECT_TRUE(field);
  Result<MesoMesh> meso = mesoMesh(mesh, field->value, options, {});
  EXPECT_TRUE(meso) << meso.error().message;
  return std::move(*meso);
}

void expectSound(const MesoMesh& m) {
  ASSERT_EQ(m.levels.size(), m.levelEnd.size());
  ASSERT_EQ(m.positions.size(), m.levelEnd.back());
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    ASSERT_NEAR(m.normals[i].norm(), 1.0f, 1e-5f);
    ASSERT_NEAR(m.tangents[i].norm(), 1.0f, 1e-5f);
    ASSERT_NEAR(m.normals[i].dot(m.tangents[i]), 0.0f, 1e-4f);
  }
  for (std::size_t k = 0; k < m.levels.size(); ++k) {
    for (std::uint32_t i = 0; i < m.levelEnd[k]; ++i) {
      float last = 0.0f;
      std::set<std::uint32_t> seen = {i};
      for (std::uint32_t j : m.neighbours(k, i)) {
        ASSERT_LT(j, m.levelEnd[k]);
        ASSERT_TRUE(seen.insert(j).second);
        const float distance = (m.positions[j] - m.positions[i]).norm();
        ASSERT_GE(distance, last * 0.9999f);
        last = distance;
      }
    }
  }
}

TEST(MesoMesh, EveryLevelIsEven) {
  for (const scene::Mesh& mesh : {scene::icosphere(1.0f, 4), scene::gridPlane(3.0f, 1.0f, 1, 1),
                                  scene::torus(1.0f, 0.3f, 50, 20)}) {
    const MesoMesh m = mesoOf(mesh, {.vertices = 20000});
    expectSound(m);
    EXPECT_NEAR(m.levelEnd.back(), 20000.0, 600.0);
    ASSERT_EQ(m.levelEnd.size(), 4u);
    for (std::size_t k = 0; k < m.levels.size(); ++k) {
      if (k > 0) {
        EXPECT_NEAR(double(m.levelEnd[k]) / m.levelEnd[k - 1], 4.0, 0.4);
      }
      double sum = 0.0, squares = 0.0, least = 1e9;
      for (std::uint32_t i = 0; i < m.levelEnd[k]; ++i) {
        ASSERT_FALSE(m.neighbours(k, i).empty());
        const double d =
            double((m.positions[m.neighbours(k, i)[0]] - m.positions[i]).norm()) / m.spacing(k);
        sum += d, squares += d * d, least = std::min(least, d);
      }
      const double mean = sum / m.levelEnd[k];
      const double deviation = std::sqrt(squares / m.levelEnd[k] - mean * mean);
      EXPECT_GT(mean, 0.72);              // 1 is a hexagonal lattice; random points have 0.47
      EXPECT_LT(deviation / mean, 0.13);  // random points have 0.52
      EXPECT_GT(least, 0.5);
    }
  }
}

TEST(MesoMesh, VerticesLieOnTheSurface) {
  const MesoMesh m = mesoOf(scene::icosphere(2.0f, 5), {.vertices = 5000});
  Vec3d mean = Vec3d::Zero();
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    EXPECT_NEAR(m.positions[i].norm(), 2.0f, 2e-3f);
    EXPECT_GT(m.positions[i].normalized().dot(m.normals[i]), 0.999f);
    mean += m.positions[i].cast<double>() / double(m.positions.size());
  }
  EXPECT_LT(mean.norm(), 0.01);
  EXPECT_NEAR(m.area, 16.0 * kPi, 0.1);
}

TEST(MesoMesh, NeighboursStayOnTheirSheet) {
  // A thin slab, another over it that looks the same way, and a plate beside: nothing may cross.
  const scene::Mesh parts[] = {
      scene::box(Vec3(1.0f, 0.004f, 1.0f), 8),
      scene::translated(scene::gridPlane(1.0f, 1.0f, 8, 8), Vec3(0, 0.005f, 0))};
  const MesoMesh m = mesoOf(scene::merge(parts), {.vertices = 4000});
  expectSound(m);
  const auto sheet = [&](std::uint32_t v) {
    const Vec3& p = m.positions[v];
    if (std::max(std::abs(p.x()), std::abs(p.z())) > 0.499f) return 0;  // the slab's rim
    const float y = p.y();
    return y > 0.004f ? 2 : y > 0.001f ? 1 : y < -0.001f ? -1 : 0;
  };
  std::size_t pairs = 0;
  for (std::size_t k = 0; k < m.levels.size(); ++k) {
    for (std::uint32_t i = 0; i < m.levelEnd[k]; ++i) {
      for (std::uint32_t j : m.neighbours(k, i)) {
        ++pairs;
        if (sheet(i) == 0 || sheet(j) == 0) continue;
        ASSERT_EQ(sheet(i), sheet(j));
      }
    }
  }
  EXPECT_GT(pairs, 25000u);
  // Each of the three is as full as the others.
  double count[4] = {};
  for (std::uint32_t v = 0; v < m.positions.size(); ++v) ++count[sheet(v) + 1];
  EXPECT_NEAR(count[0] / count[2], 1.0, 0.05);
  EXPECT_NEAR(count[3] / count[2], 1.0, 0.05);
}

TEST(MesoMesh, ARolledSheetIsNotShortCircuited) {
  // A spiral: consecutive turns are one component and look the same way.
  scene::Mesh mesh;
  const int steps = 400;
  const auto at = [](float s) {
    const float angle = 6.0f * 2.0f * float(kPi) * s, radius = 0.3f + 0.24f * s;
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = at(float(i) / steps);
    for (float z : {0.0f, 0.3f}) mesh.positions.push_back(Vec3(p.x(), p.y(), z));
    if (i == 0) continue;
    const auto v = std::uint32_t(2 * i);
    mesh.triangles.push_back({v - 2, v, v - 1});
    mesh.triangles.push_back({v, v + 1, v - 1});
  }
  scene::computeNormals(mesh);
  const MesoMesh m = mesoOf(mesh, {.vertices = 3000, .coarsest = 100});
  for (std::size_t k = 0; k < m.levels.size(); ++k) {
    for (std::uint32_t i = 0; i < m.levelEnd[k]; ++i) {
      for (std::uint32_t j : m.neighbours(k, i)) {
        // Turns are 0.04 m apart; along one turn the radius hardly changes.
        const float a = m.positions[i].head<2>().norm(), b = m.positions[j].head<2>().norm();
        ASSERT_LT(std::abs(a - b), 0.03f) << k;
      }
    }
  }
}

TEST(MesoMesh, OneTriangleAndManySmallPartsWork) {
  scene::Mesh one;
  one.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  one.triangles = {{0, 1, 2}};
  one.normals.assign(3, Vec3::UnitZ());
  expectSound(mesoOf(one, {.vertices = 1000}));
  expectSound(mesoOf(one, {.vertices = 1}));
  std::vector<scene::Mesh> parts;
  for (int i = 0; i < 40; ++i) {
    parts.push_back(scene::translated(scene::icosphere(0.05f, 1), Vec3(float(i), 0, 0)));
  }
  const MesoMesh m = mesoOf(scene::merge(parts), {.vertices = 5000});
  expectSound(m);
  std::set<int> hit;
  for (const Vec3& p : m.positions) hit.insert(int(std::lround(p.x())));
  EXPECT_EQ(hit.size(), 40u);
}

TEST(MesoMesh, TheSameAtAnyNumberOfThreads) {
  MesoMesh m[2];
  for (int i = 0; i < 2; ++i) {
    const work::ThreadLimit threads(1 + 3 * i);
    m[i] = mesoOf(scene::torus(1.0f, 0.4f, 40, 20), {.vertices = 20000});
  }
  ASSERT_EQ(m[0].positions.size(), m[1].positions.size());
  EXPECT_EQ(std::memcmp(m[0].positions.data(), m[1].positions.data(), 12 * m[0].positions.size()),
            0);
  EXPECT_EQ(std::memcmp(m[0].tangents.data(), m[1].tangents.data(), 12 * m[0].tangents.size()), 0);
  for (std::size_t k = 0; k < m[0].levels.size(); ++k) {
    EXPECT_EQ(m[0].levels[k].neighbours, m[1].levels[k].neighbours);
  }
}

TEST(MesoMesh, WhatCannotBeIsTold) {
  scene::Mesh flat;
  flat.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  flat.triangles = {{0, 1, 2}};
  flat.normals.assign(3, Vec3::UnitZ());
  TangentField field;
  field.tangents.assign(3, Vec3::UnitX());
  EXPECT_EQ(mesoMesh(flat, field, {}, {}).error().kind, ErrorKind::BadInput);
  EXPECT_EQ(mesoMesh(flat, field, {.vertices = 0}, {}).error().kind, ErrorKind::BadUsage);
  flat.positions[2] = Vec3(0, 1, 0);
  const auto stop = [](const ProgressUpdate&) { return false; };
  EXPECT_EQ(mesoMesh(flat, field, {.vertices = 100}, stop).error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace lambent::synthesis
