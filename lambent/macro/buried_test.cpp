// Where a body cuts through a mesh: what is interpolated beside it against rays from that place.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/test_bake.h"
#include "lambent/math/random.h"
#include "lambent/sh/coefficients.h"
#include "lambent/trace/cast.h"
#include "lambent/work/flush_denormals.h"

namespace lambent::macro {
namespace {

constexpr float kHalfBox = 0.5f;

/// A white floor that goes on under a box, which stands askew on it and reaches below.
scene::Scene boxOnFloor(int cells, Vec3& along, Vec3& across) {
  scene::Scene scene;
  const float angle = 0.35f;
  along = Vec3(std::cos(angle), 0, -std::sin(angle)),
  across = Vec3(std::sin(angle), 0, std::cos(angle));
  scene::addTo(scene, scene::gridPlane(3, 3, cells, cells), painted(Rgb::Ones()));
  scene::addTo(scene,
               scene::translated(scene::rotated(scene::box(Vec3(1, 1, 1), 4), Vec3::UnitY(), angle),
                                 Vec3(0.013f, 0.31f, 0.027f)),
               painted(Rgb::Constant(0.5f)));
  return scene;
}

/// Radiance of the white floor at (x, z) under uniform light, without bounces, by rays from there.
double byRays(const trace::RayScene& rays, float x, float z) {
  static const trace::DirectionSet directions(8192, math::randomRotation(77));
  const work::FlushDenormals flush;
  trace::CastResult cast;
  trace::castOcclusion(rays, directions, Vec3(x, 1e-4f, z), Vec3::UnitY(), cast);
  double sum = 0.0;
  for (const std::uint32_t d : cast.visibleDirections()) sum += directions[d].y();
  return sum * directions.weight() / kPi;
}

struct Apart {
  double rms = 0.0, worst = 0.0;  ///< relative, over places within 0.35 m of the box
};

/// `radianceAt(x, z)`: what is interpolated there.
template <class Radiance>
Apart apart(const scene::Scene& scene, const Vec3& along, const Vec3& across,
            const Radiance& radianceAt) {
  const auto rays = trace::RayScene::build(scene);
  EXPECT_TRUE(rays);
  math::Random random(11, 0);
  Apart result;
  double squares = 0.0, power = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const float a = 2.4f * random.uniform() - 1.2f;
    const float b = 2.4f * random.uniform() - 1.2f;
    const Vec3 from = Vec3(a, 0, b) - Vec3(0.013f, 0, 0.027f);
    const float outside =
        std::max(std::abs(from.dot(along)), std::abs(from.dot(across))) - kHalfBox;
    if (outside < 0.002f || outside > 0.35f) continue;
    const double right = byRays(*rays, a, b), got = radianceAt(a, b);
    squares += (got - right) * (got - right), power += right * right;
    result.worst = std::max(result.worst, std::abs(got / right - 1.0));
  }
  result.rms = std::sqrt(squares / power);
  return result;
}

BakeOptions direct() {
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.bands = 3;
  options.directions = 4096;
  return options;
}

double uniform(const BakedMesh& mesh, std::size_t receiver) {
  return mesh.vectors[receiver * mesh.channels * sh::coefficientCount(mesh.bands)] *
         std::sqrt(4.0 * kPi);
}

TEST(Buried, VerticesBesideABoxShowWhatIsThere) {
  Vec3 along, across;
  for (const int cells : {12, 30}) {
    const scene::Scene scene = boxOnFloor(cells, along, across);
    const auto baked = bakeScene(scene, direct());
    ASSERT_TRUE(baked);
    const BakedMesh floor = meshOf(baked->value, 0);
    const Apart error = apart(scene, along, across, [&](float x, float z) {
      // The cell, and in it the one of its two triangles: as gridPlane lays them.
      for (const scene::Triangle& t : scene.meshes[0].triangles) {
        Vec2 p[3];
        for (int k = 0; k < 3; ++k)
          p[k] = Vec2(scene.meshes[0].positions[t[k]].x(), scene.meshes[0].positions[t[k]].z());
        const auto cross = [](const Vec2& a, const Vec2& b) {
          return a.x() * b.y() - a.y() * b.x();
        };
        const Vec2 at(x, z);
        const float area = cross(p[1] - p[0], p[2] - p[0]);
        const float u = cross(at - p[0], p[2] - p[0]) / area;
        const float v = cross(p[1] - p[0], at - p[0]) / area;
        if (u < -1e-5f || v < -1e-5f || u + v > 1.0f + 1e-5f) continue;
        return (1 - u - v) * uniform(floor, t[0]) + u * uniform(floor, t[1]) +
               v * uniform(floor, t[2]);
      }
      return std::nan("");
    });
    // What is left lies at the box's corners, where light changes within a cell.
    EXPECT_LT(error.rms, cells == 12 ? 0.026 : 0.015) << cells;
    EXPECT_LT(error.worst, cells == 12 ? 0.17 : 0.18) << cells;
  }
}

TEST(Buried, TexelsBesideABoxShowWhatIsThere) {
  Vec3 along, across;
  constexpr int kTexels = 48;
  const scene::Scene scene = boxOnFloor(3, along, across);
  const auto baked = bakeScene(scene, direct(), {{{0, kTexels, kTexels}}, {}});
  ASSERT_TRUE(baked) << baked.error().message;
  const BakedMesh floor = meshOf(baked->value, 0);
  const Apart error = apart(scene, along, across, [&](float x, float z) {
    const float s = (x / 3.0f + 0.5f) * kTexels - 0.5f, t = (z / 3.0f + 0.5f) * kTexels - 0.5f;
    const int left = int(std::floor(s)), top = int(std::floor(t));
    const float a = s - float(left), b = t - float(top);
    const auto texel = [&](int i, int j) { return uniform(floor, std::size_t(j) * kTexels + i); };
    return (1 - b) * ((1 - a) * texel(left, top) + a * texel(left + 1, top)) +
           b * ((1 - a) * texel(left, top + 1) + a * texel(left + 1, top + 1));
  });
  EXPECT_LT(error.rms, 0.01);
  EXPECT_LT(error.worst, 0.13);
}

TEST(Buried, AFloorUnderLeavesKeepsItsShadow) {
  // A roof whose front is above: the floor below sees its back, and lies in no body.
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(4, 4, 16, 16), painted(Rgb::Ones()));
  scene::addTo(scene, scene::translated(scene::gridPlane(3, 3, 2, 2), Vec3(0, 0.2f, 0)),
               painted(Rgb::Ones()));
  const auto baked = bakeScene(scene, direct());
  ASSERT_TRUE(baked);
  EXPECT_LT(uniform(meshOf(baked->value, 0), 8 * 17 + 8), 0.05);
  for (const Finding& finding : baked->findings)
    EXPECT_EQ(finding.message.find("cuts through"), std::string::npos) << finding.message;
}

TEST(Buried, BouncesAreSetAsWellAndAllIsTheSameAtAnyNumberOfThreads) {
  Vec3 along, across;
  scene::Scene scene = boxOnFloor(12, along, across);
  scene.materials[0].diffuse = Rgb(0.8f, 0.5f, 0.3f);
  scene.materials[1].glossy = Rgb::Constant(0.3f);
  BakeOptions options = small();
  options.threads = 1;
  const auto one = bakeScene(scene, options);
  options.threads = 3;
  const auto three = bakeScene(scene, options);
  ASSERT_TRUE(one && three);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(meshOf(one->value, m).vectors, meshOf(three->value, m).vectors);
    EXPECT_EQ(meshOf(one->value, m).matrices, meshOf(three->value, m).matrices);
  }
  const auto found = std::find_if(one->findings.begin(), one->findings.end(),
                                  [](const Finding& f) { return f.code == "receivers-inside"; });
  ASSERT_NE(found, one->findings.end());
  EXPECT_EQ(found->severity, Severity::Note);
  EXPECT_NE(found->message.find("extrapolated"), std::string::npos);
  // In the middle of the box, where nobody looks, it is no darker than beside the box.
  const BakedMesh floor = meshOf(one->value, 0);
  EXPECT_GT(floor.vectors[(6 * 13 + 6) * 27] * std::sqrt(4.0 * kPi), 0.2);
}

}  // namespace
}  // namespace lambent::macro
