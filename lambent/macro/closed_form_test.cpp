// Transfer against closed forms: what a bake must yield where geometry can be integrated by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/direction_sets.h"
#include "lambent/macro/test_bake.h"
#include "lambent/math/quadrature.h"
#include "lambent/math/random.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/product.h"
#include "lambent/sh/zonal.h"
#include "lambent/transport/direction_tables.h"
#include "lambent/work/flush_denormals.h"

namespace lambent::macro {
namespace {

/// Exit radiance of a receiver under uniform light of radiance 1: only y_00 counts, whose
/// coefficient is √(4π).
double underUniformLight(const BakedMesh& mesh, std::size_t receiver, int channel = 0) {
  return mesh.vectors[(receiver * mesh.channels + channel) * sh::coefficientCount(mesh.bands)] *
         std::sqrt(4.0 * kPi);
}

scene::Material diffuse(float albedo) {
  scene::Material material;
  material.diffuse = Rgb::Constant(albedo);
  return material;
}

TEST(ClosedForm, UnoccludedTransferIsTheCosineLobe) {
  const scene::Scene scene = scene::sceneOf(scene::icosphere(1.0f, 2), diffuse(0.6f));
  for (const transfer::Kind kind : {transfer::Kind::Unshadowed, transfer::Kind::Shadowed}) {
    BakeOptions options;
    options.kind = kind;
    options.bands = 7;
    const transfer::SimulatedField field = bakeOrDie(scene, options);
    const sh::ZonalMoments cosine = sh::clampedCosine(7);
    const BakedMesh mesh = meshOf(field, 0);
    for (std::size_t r = 0; r < mesh.receiverCount(); ++r) {
      std::vector<double> y(49);
      sh::evaluate(7, Vec3d(mesh.normals[r].cast<double>()), y);
      for (int i = 0; i < 49; ++i)
        EXPECT_NEAR(mesh.vectors[r * 49 + i], 0.6 / kPi * cosine[sh::bandOf(i)] * y[i], 1e-6);
    }
  }
}

TEST(ClosedForm, AConvexWhiteBodyUnderUniformLightHasRadianceOne) {
  scene::Scene scene;
  scene::addTo(scene, scene::icosphere(2.0f, 3), diffuse(1.0f));
  BakeOptions options;
  options.kind = transfer::Kind::Interreflected;
  const BakedMesh sphere = meshOf(bakeOrDie(scene, options), 0);
  for (std::size_t r = 0; r < sphere.receiverCount(); ++r)
    EXPECT_NEAR(underUniformLight(sphere, r), 1.0, 1e-6);
}

TEST(ClosedForm, SphereAboveAPlaneShadowsAsMuchAsItCovers) {
  // A sphere of radius r at distance D in direction θ from the normal: E/E₀ = 1 − cos θ (r/D)².
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(8.0f, 8.0f, 8, 8), diffuse(1.0f));
  scene::addTo(scene, scene::translated(scene::icosphere(1.0f, 4), Vec3(0, 2, 0)), diffuse(0.0f));
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 32768;
  const BakedMesh plane = meshOf(bakeOrDie(scene, options), 0);
  double worst = 0.0;
  for (std::size_t r = 0; r < plane.receiverCount(); ++r) {
    const double distance = (plane.positions[r] - Vec3(0, 2, 0)).cast<double>().norm();
    const double cosine = 2.0 / distance;
    if (cosine * distance <= 1.0) continue;
    const double expected = 1.0 - cosine / (distance * distance);
    worst = std::max(worst, std::abs(underUniformLight(plane, r) - expected));
  }
  // 16,384 directions a hemisphere leave some 1e-3; the faceted sphere covers .1% less.
  EXPECT_LT(worst, 2e-3);
}

TEST(ClosedForm, SphereShadowInBands) {
  // Straight below the sphere, a cap about the normal is blocked and an annulus left: the vector is
  // the projection of max(cos θ, 0) on cos θ < cos α, turned to the normal.
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(0.1f, 0.1f, 2, 2), diffuse(1.0f));
  scene::addTo(scene, scene::translated(scene::icosphere(1.0f, 4), Vec3(0, 2, 0)), diffuse(0.0f));
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 32768;
  const BakedMesh plane = meshOf(bakeOrDie(scene, options), 0);
  std::size_t centre = 0;
  for (std::size_t r = 0; r < plane.receiverCount(); ++r)
    if (plane.positions[r].norm() < plane.positions[centre].norm()) centre = r;
  const double cosAlpha = std::sqrt(1.0 - 0.25);
  sh::ZonalMoments annulus(5);
  const math::Quadrature rule = math::gaussLegendre(8, 0.0, cosAlpha);
  for (int l = 0; l < 5; ++l)
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      annulus[l] += 2.0 * kPi * rule.weights[k] * rule.nodes[k] *
                    std::legendre(static_cast<unsigned>(l), rule.nodes[k]);
  std::vector<double> expected(25);
  sh::turnTo(annulus, Vec3d(0, 1, 0), std::span<double>(expected));
  for (int i = 0; i < 25; ++i)
    EXPECT_NEAR(plane.vectors[centre * 25 + i], expected[i] / kPi, 1.5e-3);
}

TEST(ClosedForm, BowlFillsWithLightByTheGeometricSeries) {
  // A patch of a sphere with the fraction s of its area, concave side: every point has the exit
  // radiance ρ(1−s)/(1−ρs); bounce b adds ρ(1−s)(ρs)^b.
  const double s = 0.5, rho = 0.5;
  const scene::Scene scene =
      scene::sceneOf(scene::bowl(1.0f, float(s), 64, 32), diffuse(float(rho)));
  double before = 0.0;
  for (const int bounces : {0, 1, 2, 6}) {
    BakeOptions options;
    options.kind = transfer::Kind::Interreflected;
    options.bounces = bounces;
    options.directions = 2048;
    options.bands = 2;
    const BakedMesh bowl = meshOf(bakeOrDie(scene, options), 0);
    double mean = 0.0, low = 1e9, high = -1e9;
    std::size_t counted = 0;
    for (std::size_t r = 0; r < bowl.receiverCount(); ++r) {
      // The rim itself sees the back of nothing: its directions graze the faceted edge.
      if (bowl.positions[r].y() > -0.05f) continue;
      const double radiance = underUniformLight(bowl, r);
      mean += radiance;
      low = std::min(low, radiance), high = std::max(high, radiance);
      ++counted;
    }
    mean /= static_cast<double>(counted);
    double expected = 0.0;
    for (int b = 0; b <= bounces; ++b) expected += rho * (1 - s) * std::pow(rho * s, b);
    // Facets of 32 stacks leave .2%; 1,024 directions a hemisphere as much.
    EXPECT_NEAR(mean, expected, 3e-3) << bounces;
    EXPECT_LT(high - low, 0.02) << bounces;
    EXPECT_GT(mean, before);
    before = mean;
  }
  EXPECT_NEAR(before, 1.0 / 3.0, 3e-3);
}

TEST(ClosedForm, ClosedRoomIsBlackToTheSkyAndNoLightLeaksIn) {
  const scene::Scene scene = scene::sceneOf(scene::room(Vec3(2, 1, 3), 8), diffuse(0.9f));
  BakeOptions options;
  options.kind = transfer::Kind::Interreflected;
  options.bounces = 3;
  const BakedMesh room = meshOf(bakeOrDie(scene, options), 0);
  for (const float value : room.vectors) EXPECT_EQ(value, 0.0f);
}

TEST(ClosedForm, GlossyShadowedMatrixIsTheSumOverDirectionsEntryForEntry) {
  // The paper's rule, naively, over the same directions: Σ w V y_i y_j. Half the hemisphere is
  // blocked by a wall, and visibility enters in full (no analytic part), so both sums agree.
  scene::Scene scene;
  scene::Material glossy = diffuse(0.0f);
  glossy.glossy = Rgb::Ones();
  scene::addTo(scene, scene::gridPlane(0.5f, 0.5f, 1, 1), glossy);
  scene::addTo(scene, scene::translated(scene::box(Vec3(4, 4, 4)), Vec3(2.3f, 0, 0)), diffuse(0));
  scene::addTo(scene, scene::translated(scene::box(Vec3(4, 4, 4)), Vec3(0, 0, 2.3f)), diffuse(0));
  const auto rays = trace::RayScene::build(scene);
  ASSERT_TRUE(rays);
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.bands = 3;
  options.glossyBands = 5;
  options.directions = 2048;
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  ASSERT_TRUE(receivers);
  const auto field = bake(scene, *rays, *receivers, options, {});
  ASSERT_TRUE(field);
  const BakedMesh plane = meshOf(field->value, 0);
  ASSERT_EQ(plane.outBands, 5);
  ASSERT_EQ(plane.inBands, 3);
  // The very directions of the bake.
  const DirectionSets sets(options.directions, options.seed, scene::bounds(scene));
  const work::FlushDenormals flush;
  int compared = 0;
  for (std::size_t r = 0; r < plane.receiverCount(); ++r) {
    const trace::DirectionSet& directions = sets[sets.numberAt(plane.positions[r])];
    std::vector<double> expected(25 * 9, 0.0), y(25);
    std::size_t visible = 0, above = 0;
    for (std::size_t d = 0; d < directions.size(); ++d) {
      if (plane.normals[r].dot(directions[d]) <= 0.0f) continue;
      ++above;
      if (rays->occluded(plane.positions[r] + rays->offset() * plane.normals[r], directions[d]))
        continue;
      ++visible;
      sh::evaluate(5, Vec3d(directions[d].cast<double>()), y);
      for (int i = 0; i < 25; ++i)
        for (int j = 0; j < 9; ++j) expected[i * 9 + j] += directions.weight() * y[i] * y[j];
    }
    if (2 * visible >= above) continue;  // summed by what is blocked: see the next test
    ++compared;
    for (int k = 0; k < 25 * 9; ++k)
      EXPECT_NEAR(plane.matrices[r * 25 * 9 + k], expected[k], 2e-5) << r << " " << k;
  }
  EXPECT_GT(compared, 0);
}

TEST(ClosedForm, GlossyMatrixOfAnOpenReceiverIsTheHemispheresProductMatrix) {
  scene::Scene scene;
  scene::Material glossy = diffuse(0.0f);
  glossy.glossy = Rgb::Ones();
  scene::addTo(scene, scene::rotated(scene::gridPlane(1, 1, 1, 1), Vec3(1, 0, 0), float(kPi / 2)),
               glossy);  // faces +z
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.bands = options.glossyBands = 3;
  const BakedMesh plane = meshOf(bakeOrDie(scene, options), 0);
  ASSERT_GT(plane.normals[0].z(), 0.99f);
  const auto entry = [&](int i, int j) { return plane.matrices[i * 9 + j]; };
  EXPECT_NEAR(entry(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(entry(0, 2), std::sqrt(3.0) / 4.0, 1e-6);
  EXPECT_NEAR(entry(2, 6), 0.242061, 1e-6);
  EXPECT_NEAR(entry(0, 6), 0.0, 1e-6);
}

TEST(ClosedForm, UnshadowedGlossyMatrixIsTheIdentity) {
  scene::Scene scene;
  scene::Material glossy = diffuse(0.0f);
  glossy.glossy = Rgb::Ones();
  scene::addTo(scene, scene::icosphere(1, 0), glossy);
  BakeOptions options;
  options.kind = transfer::Kind::Unshadowed;
  options.bands = 3, options.glossyBands = 4;
  const BakedMesh body = meshOf(bakeOrDie(scene, options), 0);
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 9; ++j) EXPECT_EQ(body.matrices[i * 9 + j], i == j ? 1.0f : 0.0f);
}

TEST(ClosedForm, MirrorWallDoublesTheSky) {
  // A receiver beside an infinite perfect mirror wall sees the sky's mirror image in it: under
  // uniform light it is lit as in the open. (The wall is finite: 40 units against a distance of 1.)
  scene::Scene scene;
  scene::Material mirror;
  mirror.mirror = Rgb::Ones();
  scene::addTo(scene, scene::gridPlane(0.2f, 0.2f, 1, 1), diffuse(1.0f));
  scene::addTo(scene,
               scene::translated(
                   scene::rotated(scene::gridPlane(80, 80, 1, 1), Vec3(0, 0, 1), float(kPi / 2)),
                   Vec3(1, 0, 0)),
               mirror);  // faces −x
  BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 16384;
  const BakedMesh plane = meshOf(bakeOrDie(scene, options), 0);
  for (std::size_t r = 0; r < plane.receiverCount(); ++r) {
    // Mirrored light from below the horizon cannot reach an upward receiver: reflection in a
    // vertical wall keeps the height of a direction, so nothing is lost.
    EXPECT_NEAR(underUniformLight(plane, r), 1.0, 2e-3);
    // The vector itself is that of a sky folded over: symmetric in x only where blocked; the
    // linear x moment must be negative, as all light comes from −x.
    EXPECT_LT(plane.vectors[r * 25 + sh::index(1, 1)], -0.05f);
  }
}

TEST(ClosedForm, GlossyBounceLooksWhereTheMirroredRayGoes) {
  // A diffuse receiver faces a sharp glossy floor below it; the light comes from +x, 45° up. The
  // floor must throw it towards −x going up: a receiver on a wall at +x facing −x gets nothing by
  // the lobe, a receiver on a wall at −x facing +x does. Reversing the paper's sign swaps them.
  scene::Scene scene;
  scene::Material glossy = diffuse(0.0f);
  glossy.glossy = Rgb::Ones();
  glossy.lobeExponent = 64.0f;
  scene::addTo(scene, scene::gridPlane(2, 2, 8, 8), glossy);
  const auto wall = [&](float x, float turn) {
    return scene::translated(
        scene::rotated(scene::gridPlane(0.1f, 0.1f, 1, 1), Vec3(0, 0, 1), turn), Vec3(x, 0.7f, 0));
  };
  scene::addTo(scene, wall(-0.7f, float(-kPi / 2)), diffuse(1.0f));  // faces +x
  scene::addTo(scene, wall(0.7f, float(kPi / 2)), diffuse(1.0f));    // faces −x
  BakeOptions options;
  options.kind = transfer::Kind::Interreflected;
  options.bounces = 1;
  options.bands = options.glossyBands = 9;
  const transfer::SimulatedField full = bakeOrDie(scene, options);
  options.bounces = 0;
  const transfer::SimulatedField direct = bakeOrDie(scene, options);
  ASSERT_GT(meshOf(full, 1).normals[0].x(), 0.99f);
  std::vector<double> light(81);
  sh::turnTo(sh::cap(9, 0.3), Vec3d(1, 1, 0).normalized(), std::span<double>(light));
  const auto bounced = [&](int mesh) {
    const BakedMesh after = meshOf(full, std::size_t(mesh)),
                    before = meshOf(direct, std::size_t(mesh));
    double sum = 0.0;
    for (int i = 0; i < 81; ++i) sum += light[i] * (after.vectors[i] - before.vectors[i]);
    return sum;
  };
  EXPECT_GT(bounced(1), 0.01);
  EXPECT_LT(std::abs(bounced(2)), 0.1 * bounced(1));
}

}  // namespace
}  // namespace lambent::macro
