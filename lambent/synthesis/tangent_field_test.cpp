#include "lambent/synthesis/tangent_field.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "lambent/math/random.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene/shapes.h"
#include "lambent/synthesis/connection_solver.h"

namespace lambent::synthesis {
namespace {

TangentField fieldOf(const scene::Mesh& mesh, const TangentFieldOptions& options = {}) {
  auto made = tangentField(mesh, options);
  EXPECT_TRUE(made) << made.error().message;
  TangentField& field = made->value;
  EXPECT_EQ(field.tangents.size(), mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(field.tangents[v].norm(), 1.0f, 1e-5f);
    EXPECT_NEAR(field.tangents[v].dot(mesh.normals[v]), 0.0f, 1e-4f);
  }
  return std::move(field);
}

int indexSum(const TangentField& field) {
  int sum = 0;
  for (const auto& s : field.singularities) sum += s.index;
  return sum;
}

scene::Mesh noisy(scene::Mesh mesh, float amount) {
  std::map<std::array<float, 3>, Vec3> moved;
  for (Vec3& p : mesh.positions) {
    math::Random random(7, moved.size());
    const Vec3 offset(random.uniform() - 0.5f, random.uniform() - 0.5f, random.uniform() - 0.5f);
    p = moved.try_emplace({p.x(), p.y(), p.z()}, p + amount * offset).first->second;
  }
  scene::computeNormals(mesh);
  return mesh;
}

/// A slab with two square holes, of quads cut in two: genus 2.
scene::Mesh doubleTorus() {
  const auto solid = [](int x, int y, int z) {
    if (x < 0 || x >= 20 || y < 0 || y >= 12 || z < 0 || z >= 4) return false;
    const bool rows = y >= 4 && y < 8;
    return !(rows && ((x >= 4 && x < 8) || (x >= 12 && x < 16)));
  };
  scene::Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, fresh] = known.try_emplace(p, std::uint32_t(mesh.positions.size()));
    if (fresh) mesh.positions.push_back(Vec3(float(p[0]), float(p[1]), float(p[2])));
    return at->second;
  };
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 4; ++z) {
        if (!solid(x, y, z)) continue;
        for (int axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side) {
            std::array<int, 3> beyond = {x, y, z};
            beyond[axis] += side == 1 ? 1 : -1;
            if (solid(beyond[0], beyond[1], beyond[2])) continue;
            std::uint32_t v[4];
            for (int k = 0; k < 4; ++k) {
              std::array<int, 3> p = {x, y, z};
              p[axis] += side;
              p[(axis + 1) % 3] += (k == 1 || k == 2);
              p[(axis + 2) % 3] += k >= 2;
              v[k] = vertex(p);
            }
            if (side == 0) std::swap(v[1], v[3]);
            mesh.triangles.push_back({v[0], v[1], v[2]});
            mesh.triangles.push_back({v[0], v[2], v[3]});
          }
      }
  scene::computeNormals(mesh);
  return mesh;
}

TEST(TangentField, ASphereHasTwoSingularitiesFarApart) {
  for (const scene::Mesh& mesh : {scene::icosphere(1.0f, 4), scene::uvSphere(2.0f, 64, 32)}) {
    const TangentField field = fieldOf(mesh);
    ASSERT_EQ(field.singularities.size(), 2u);
    Vec3 at[2];
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(field.singularities[i].index, 1);
      at[i] = mesh.positions[mesh.triangles[field.singularities[i].triangle][0]].normalized();
    }
    EXPECT_LT(at[0].dot(at[1]), -0.8f);
  }
}

TEST(TangentField, ATorusHasNone) {
  EXPECT_TRUE(fieldOf(scene::torus(1.0f, 0.4f, 60, 30)).singularities.empty());
  EXPECT_TRUE(fieldOf(scene::rotated(scene::torus(1.0f, 0.4f, 60, 30), Vec3(1, 0, 0), 1.0f))
                  .singularities.empty());
}

TEST(TangentField, IndicesSumToTheEulerCharacteristic) {
  EXPECT_EQ(indexSum(fieldOf(noisy(scene::icosphere(1.0f, 4), 0.06f))), 2);
  EXPECT_EQ(indexSum(fieldOf(noisy(scene::torus(1.0f, 0.4f, 60, 30), 0.05f))), 0);
  EXPECT_EQ(indexSum(fieldOf(scene::box(Vec3(1, 2, 3), 4))), 2);
  EXPECT_EQ(indexSum(fieldOf(scene::box(Vec3(1, 1, 1), 1))), 2);
  const scene::Mesh two = doubleTorus();
  ASSERT_TRUE(scene::topology(two).closed());
  EXPECT_EQ(indexSum(fieldOf(two)), -2);
  EXPECT_LE(fieldOf(two).singularities.size(), 8u);
}

TEST(TangentField, EveryComponentHasItsOwnSmoothField) {
  const scene::Mesh parts[] = {
      scene::icosphere(1.0f, 3), scene::translated(scene::icosphere(0.01f, 3), Vec3(3, 0, 0)),
      scene::translated(scene::torus(100.0f, 30.0f, 40, 20), Vec3(0, 200, 0))};
  const TangentField field = fieldOf(scene::merge(parts));
  EXPECT_EQ(indexSum(field), 4);
  EXPECT_EQ(field.singularities.size(), 4u);
}

TEST(TangentField, BordersOfUvsLeaveNoSeam) {
  const scene::Mesh mesh = scene::uvSphere(1.0f, 48, 24);
  const TangentField field = fieldOf(mesh);
  std::map<std::array<float, 3>, Vec3> first;
  std::size_t doubled = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v] + Vec3::Zero();
    const auto [at, fresh] = first.try_emplace({p.x(), p.y(), p.z()}, field.tangents[v]);
    doubled += !fresh;
    EXPECT_GT(at->second.dot(field.tangents[v]), 0.99f);
  }
  EXPECT_GT(doubled, 20u);
}

TEST(TangentField, AFlatSheetHasAConstantField) {
  const TangentField field = fieldOf(scene::gridPlane(3.0f, 1.0f, 30, 10));
  EXPECT_TRUE(field.singularities.empty());
  for (const Vec3& t : field.tangents) EXPECT_GT(t.dot(field.tangents[0]), 0.9999f);
}

TEST(TangentField, SteeringFollowsTheDirection) {
  const scene::Mesh mesh = scene::icosphere(1.0f, 4);
  TangentFieldOptions options;
  options.direction = Vec3(1.0f, 2.0f, -0.5f);
  const Vec3 direction = options.direction->normalized();
  float before = 0.0f;
  for (float steering : {0.5f, 0.9f, 1.0f}) {
    options.steering = steering;
    const TangentField field = fieldOf(mesh, options);
    EXPECT_EQ(indexSum(field), 2);
    double sum = 0.0, weights = 0.0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3 flat = direction - direction.dot(mesh.normals[v]) * mesh.normals[v];
      sum += double(flat.dot(field.tangents[v])), weights += double(flat.norm());
    }
    EXPECT_GE(sum / weights, before - 1e-4);
    EXPECT_GT(sum / weights, 0.98);
    before = float(sum / weights);
  }
  EXPECT_GT(before, 0.9999f);
}

/// A flat ring, radii 0.3 to 1: `around` × `across` quads.
scene::Mesh flatRing(int around, int across) {
  scene::Mesh mesh;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i < around; ++i) {
      const double radius = 0.3 + 0.7 * j / across, angle = 2.0 * kPi * i / around;
      mesh.positions.emplace_back(float(radius * std::cos(angle)), 0.0f,
                                  float(radius * std::sin(angle)));
      mesh.normals.push_back(Vec3::UnitY());
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * around + i % around); };
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// cos of four times the angle between a tangent and a direction in its plane: 1 along or across.
double crosswise(const Vec3& tangent, const Vec3& direction) {
  const double c = double(tangent.dot(direction));
  return 8.0 * (c * c * c * c - c * c) + 1.0;
}

TEST(TangentField, ByItselfFollowsTheBordersOfASheetWithAHole) {
  const scene::Mesh ring = flatRing(48, 10);
  for (const int turns : {1, 2, 4}) {
    TangentFieldOptions options;
    options.turns = turns;
    const TangentField smooth = fieldOf(ring, options);
    options.align = true;
    const TangentField aligned = fieldOf(ring, options);
    EXPECT_EQ(aligned.featureLines, 2u);
    EXPECT_EQ(aligned.alignedLines, 2u);
    EXPECT_TRUE(aligned.singularities.empty());
    double before = 0.0, least = 1.0;
    for (std::size_t v = 0; v < ring.positions.size(); ++v) {
      const Vec3 outwards = ring.positions[v].normalized();
      before += crosswise(smooth.tangents[v], outwards) / double(ring.positions.size());
      least = std::min(least, crosswise(aligned.tangents[v], outwards));
    }
    EXPECT_LT(std::abs(before), 0.1) << "the same all over";
    EXPECT_GT(least, 0.99) << turns;
  }
}

TEST(TangentField, ByItselfFollowsTheCreasesOfACylinderWithCaps) {
  const scene::Mesh cylinder = scene::cylinder(1.0f, 2.0f, 40, 10);
  TangentFieldOptions options;
  options.turns = 4;
  options.align = true;
  const TangentField field = fieldOf(cylinder, options);
  EXPECT_EQ(field.featureLines, 2u);
  EXPECT_EQ(field.alignedLines, 2u);
  EXPECT_EQ(indexSum(field), 8);
  double least = 1.0;
  for (std::size_t v = 0; v < cylinder.positions.size(); ++v) {
    const Vec3& p = cylinder.positions[v];
    if (Vec2(p.x(), p.z()).norm() < 0.99f) continue;  // inside of a cap
    least = std::min(least, crosswise(field.tangents[v], Vec3(-p.z(), 0, p.x()).normalized()));
  }
  EXPECT_GT(least, 0.9);
}

TEST(TangentField, ABoxHasItsSingularitiesAtItsCorners) {
  const scene::Mesh box = scene::box(Vec3(1, 2, 3), 8);
  TangentFieldOptions options;
  options.align = true;
  options.turns = 4;
  const TangentField four = fieldOf(box, options);
  EXPECT_EQ(four.featureLines, 12u);
  EXPECT_EQ(indexSum(four), 8);
  EXPECT_EQ(four.singularities.size(), 8u);
  // Whatever the turns, courses are level with the edges.
  for (const int turns : {1, 2, 4}) {
    options.turns = turns;
    const TangentField field = fieldOf(box, options);
    double sum = 0.0;
    for (const Vec3& t : field.tangents) {
      const float most = t.cwiseAbs().maxCoeff();
      sum += most > 0.98f;
    }
    EXPECT_GT(sum / double(field.tangents.size()), 0.7) << turns;
  }
}

TEST(TangentField, WithoutCreasesAndBordersNothingIsAligned) {
  const scene::Mesh mesh = scene::icosphere(1.0f, 3);
  TangentFieldOptions options;
  const TangentField smooth = fieldOf(mesh, options);
  options.align = true;
  const TangentField same = fieldOf(mesh, options);
  EXPECT_EQ(same.featureLines, 0u);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_EQ(same.tangents[v], smooth.tangents[v]);
}

TEST(TangentField, GuidesAreFollowedWhereTheyWeighAndContinuedBetween) {
  const scene::Mesh plane = scene::gridPlane(2.0f, 2.0f, 20, 20);
  for (const int turns : {1, 2, 4}) {
    TangentFieldOptions options;
    options.turns = turns;
    options.guides.resize(plane.positions.size());
    // +x on the left, and 30° from it on the right: from one to the other evenly.
    const Vec3 turned(std::cos(0.5236f), 0.0f, std::sin(0.5236f));
    for (std::size_t v = 0; v < plane.positions.size(); ++v) {
      if (plane.positions[v].x() < -0.99f) options.guides[v] = {Vec3(2, 0, 0), 1.0f};
      if (plane.positions[v].x() > 0.99f) options.guides[v] = {turned, 1.0f};
    }
    const TangentField field = fieldOf(plane, options);
    for (std::size_t v = 0; v < plane.positions.size(); ++v) {
      const float angle = 0.5236f * (0.5f + 0.5f * plane.positions[v].x());
      const Vec3 expected(std::cos(angle), 0.0f, std::sin(angle));
      const float off = std::acos(std::clamp(field.tangents[v].dot(expected), -1.0f, 1.0f));
      const float period = 2.0f * float(kPi) / float(turns);
      EXPECT_LT(std::abs(std::remainder(off, period)), 0.03f) << turns;
    }
  }
  TangentFieldOptions wrong;
  wrong.guides.resize(3);
  EXPECT_EQ(tangentField(plane, wrong).error().kind, ErrorKind::BadUsage);
}

TEST(TangentField, OneComponentsGuidesLeaveTheOthersAsTheyAre) {
  const scene::Mesh parts[] = {scene::gridPlane(1, 1, 6, 6),
                               scene::translated(scene::icosphere(1.0f, 3), Vec3(3, 0, 0))};
  const scene::Mesh both = scene::merge(parts);
  TangentFieldOptions options;
  const TangentField smooth = fieldOf(both, options);
  options.guides.resize(both.positions.size());
  options.guides[10] = {Vec3(1, 0, 1), 1.0f};
  const TangentField guided = fieldOf(both, options);
  for (std::size_t v = 0; v < both.positions.size(); ++v) {
    if (v < 49)
      EXPECT_GT(guided.tangents[v].dot(Vec3(1, 0, 1).normalized()), 0.99f);
    else
      EXPECT_GT(guided.tangents[v].dot(smooth.tangents[v]), 0.9f) << v;
  }
}

TEST(TangentField, FinsMirroredTrianglesAndSliversAreSurvivedAndTold) {
  scene::Mesh mesh = scene::icosphere(1.0f, 2);
  const auto fin = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back(Vec3(3, 3, 3));
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][1], fin});
  std::swap(mesh.triangles[9][0], mesh.triangles[9][1]);
  mesh.triangles.push_back({1, 1, 2});
  mesh.positions.push_back(Vec3(9, 9, 9));  // no triangle's
  scene::computeNormals(mesh);
  const auto made = tangentField(mesh, {});
  ASSERT_TRUE(made);
  const auto& [field, findings] = *made;
  for (const Vec3& t : field.tangents) EXPECT_NEAR(t.norm(), 1.0f, 1e-5f);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].code, "non-manifold-edges");
  EXPECT_EQ(findings[0].count, 1u);
  EXPECT_EQ(findings[1].code, "inconsistent-winding");
  EXPECT_EQ(findings[1].count, 3u);
  EXPECT_EQ(findings[2].code, "degenerate-triangles");
}

TEST(TangentField, TrianglesWithoutAreaAreSurvived) {
  scene::Mesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5)};
  mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}};
  mesh.normals.assign(5, Vec3::UnitZ());
  fieldOf(mesh);
}

TEST(TangentField, LargeMeshesAreSolvedAsSmallOnesAre) {
  // The Laplacian of a twisted ladder, above and below the size that is factorised.
  using Complex = ConnectionSolver::Complex;
  const int n = 4000;
  std::vector<Eigen::Triplet<Complex>> entries;
  std::vector<double> diagonal(n, 1e-3);
  for (int i = 0; i < n; ++i) {
    for (int step : {1, 7, 60}) {
      if (i + step >= n) continue;
      const double w = 0.5 + double(math::Random(5, std::uint64_t(i)).uniform());
      entries.emplace_back(i + step, i, -std::polar(w, 0.01 * step + 1e-4 * i));
      diagonal[std::size_t(i)] += w, diagonal[std::size_t(i + step)] += w;
    }
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[std::size_t(i)]);
  ConnectionSolver::Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  ConnectionSolver::Field b(n);
  for (int i = 0; i < n; ++i) b[i] = Complex(std::sin(0.01 * i), std::cos(0.3 * i));
  const ConnectionSolver direct(matrix), iterated(matrix, 100);
  ASSERT_TRUE(direct.ok() && iterated.ok());
  const ConnectionSolver::Field zero = ConnectionSolver::Field::Zero(n);
  const ConnectionSolver::Field x = direct.solve(b, zero, 0.0);
  EXPECT_LT((iterated.solve(b, zero, 1e-10) - x).norm(), 1e-6 * x.norm());
}

TEST(TangentField, WrongUsageIsToldApart) {
  EXPECT_EQ(tangentField(scene::Mesh(), {}).error().kind, ErrorKind::BadInput);
  TangentFieldOptions options;
  options.direction = Vec3(0, 0, 0);
  EXPECT_EQ(tangentField(scene::icosphere(1, 1), options).error().kind, ErrorKind::BadUsage);
  options.direction = Vec3(0, 1, 0);
  options.steering = 2.0f;
  EXPECT_EQ(tangentField(scene::icosphere(1, 1), options).error().kind, ErrorKind::BadUsage);
}

}  // namespace
}  // namespace lambent::synthesis
