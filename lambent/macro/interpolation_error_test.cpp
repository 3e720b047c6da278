// What is interpolated between receivers against what is seen between them.
#include "lambent/macro/interpolation_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/sight.h"
#include "lambent/macro/test_bake.h"
#include "lambent/scene/shapes.h"
#include "lambent/work/flush_denormals.h"

namespace lambent::macro {
namespace {

/// A box on a floor of quads².
scene::Scene boxOnFloor(int quads) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(6, 6, quads, quads), painted(Rgb::Constant(0.7f)));
  scene.meshes[0].name = "floor";
  scene::addTo(scene, scene::translated(scene::box(Vec3(1, 1, 1), 8), Vec3(0.3f, 0.5f, -0.2f)),
               painted(Rgb::Constant(0.5f)));
  return scene;
}

InterpolationError errorOf(const scene::Scene& scene, int threads = 0) {
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  InterpolationErrorOptions options;
  options.threads = threads;
  auto error = interpolationError(scene, *rays, *receivers, options, {});
  EXPECT_TRUE(error && error->has_value());
  return **error;
}

// A long wall of height h hides the share (1 − x/√(x² + h²))/2 of an even sky from a floor at a
// distance x. With one band the error is that of radiance under an even sky.
TEST(InterpolationError, IsThatOfAWallInClosedForm) {
  constexpr float kHeight = 1.0f;
  scene::Scene scene = scene::sceneOf(
      scene::translated(scene::box(Vec3(0.2f, kHeight, 80)), Vec3(-0.1f, 0.5f * kHeight, 0)));
  const auto rays = trace::RayScene::build(scene);
  ASSERT_TRUE(rays);
  const work::FlushDenormals flushed;
  const auto hidden = [](double x) { return 0.5 * (1.0 - x / std::hypot(x, double(kHeight))); };
  const auto spot = [&](float x) { return Spot{Vec3(x, rays->offset(), 0), Vec3::UnitY()}; };
  SightTest::Scratch scratch;
  for (const auto& [near, far] : {std::pair(0.1f, 1.1f), std::pair(0.05f, 3.0f)}) {
    double sum = 0.0;
    constexpr int kSeeds = 200;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const SightTest test(*rays, 1, std::uint64_t(seed));
      const Sight a = test.at(spot(near), scratch), b = test.at(spot(far), scratch);
      const Sight here = test.at(spot(0.5f * (near + far)), scratch);
      EXPECT_FALSE(here.buried);
      sum += test.squaredError(here, Corners::ofTriangle({&a, &b, &b}, Vec3(0.5f, 0.25f, 0.25f)),
                               Vec3::UnitY(), scratch);
    }
    const double expected =
        hidden(0.5 * (near + far)) - 0.5 * (hidden(double(near)) + hidden(double(far)));
    EXPECT_NEAR(sum / kSeeds, expected * expected, 0.06 * expected * expected);
  }
}

// An error of nothing is an error of nothing on the mean, though each set of directions errs.
TEST(InterpolationError, NoiseIsTakenOut) {
  scene::Scene scene =
      scene::sceneOf(scene::translated(scene::box(Vec3(0.2f, 1, 80)), Vec3(-0.1f, 0.5f, 0)));
  const auto rays = trace::RayScene::build(scene);
  const work::FlushDenormals flushed;
  SightTest::Scratch scratch;
  double sum = 0.0, square = 0.0;
  constexpr int kSeeds = 400;
  // Along the wall nothing changes, but which directions are open does, at its ends.
  for (int seed = 0; seed < kSeeds; ++seed) {
    const SightTest test(*rays, 5, std::uint64_t(seed));
    const auto see = [&](float z) {
      return test.at({Vec3(0.5f, rays->offset(), z), Vec3::UnitY()}, scratch);
    };
    const Sight a = see(-20), b = see(20), here = see(0);
    const double e = test.squaredError(here, Corners::ofTriangle({&a, &b, &b}, Vec3(0.5f, 0.5f, 0)),
                                       Vec3::UnitY(), scratch);
    sum += e, square += e * e;
  }
  const double error = std::sqrt(square / kSeeds / kSeeds);
  EXPECT_NEAR(sum / kSeeds, 0.0, 4.0 * error + 1e-6);
}

TEST(InterpolationError, IsNothingOnAnOpenPlane) {
  EXPECT_EQ(errorOf(scene::sceneOf(scene::gridPlane(6, 6, 1, 1))).rms, 0.0);
  EXPECT_EQ(errorOf(scene::sceneOf(scene::box(Vec3(1, 2, 3)))).rms, 0.0);
}

TEST(InterpolationError, FindsABoxOnAFloorOfTwoTriangles) {
  const scene::Scene coarse = boxOnFloor(1), fine = boxOnFloor(60);
  const InterpolationError large = errorOf(coarse), small = errorOf(fine);
  EXPECT_GT(large.rms, 0.06);
  EXPECT_LT(small.rms, 0.025);
  EXPECT_EQ(large.worstMesh, 0u);
  EXPECT_GT(large.beyond, 0.2);
  const Findings told = findingsOf(large, coarse, {}, "--refine");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "coarse-receivers");
  EXPECT_NE(told[0].message.find("\"floor\""), std::string::npos);
  EXPECT_TRUE(findingsOf(small, fine, {}, "--refine").empty());
}

// However large the floor is beside it.
TEST(InterpolationError, FindsASmallBoxOnALargeFloor) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(1000, 1000, 1, 1), painted(Rgb::Constant(0.7f)));
  scene::addTo(scene, scene::translated(scene::box(Vec3(1, 1, 1), 4), Vec3(30, 0.5f, -120)),
               painted(Rgb::Constant(0.5f)));
  EXPECT_GT(errorOf(scene).rms, 0.04);
}

TEST(InterpolationError, IsTheSameAtAnyThreadCount) {
  const InterpolationError one = errorOf(boxOnFloor(3), 1), four = errorOf(boxOnFloor(3), 4);
  EXPECT_EQ(one.rms, four.rms);
  EXPECT_EQ(one.samples, four.samples);
  EXPECT_EQ(one.beyond, four.beyond);
}

// A floor inside of a closed box: nobody sees it, and it is dark all over.
TEST(InterpolationError, PlacesInsideOfBodiesDoNotCount) {
  scene::Scene scene;
  scene::addTo(scene, scene::translated(scene::box(Vec3(3, 2, 3), 4), Vec3(0, 1, 0)),
               painted(Rgb::Constant(0.5f)));
  scene::addTo(scene, scene::translated(scene::gridPlane(2, 2, 1, 1), Vec3(0, 1, 0)),
               painted(Rgb::Constant(0.5f)));
  EXPECT_EQ(errorOf(scene).rms, 0.0);
}

TEST(InterpolationError, NothingStandsAtVertices) {
  const scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 1, 1));
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {{{0, 8, 8}}, {}}, rays->offset());
  const auto error = interpolationError(scene, *rays, *receivers, {}, {});
  ASSERT_TRUE(error);
  EXPECT_FALSE(error->has_value());
}

// A ball hides nothing from itself, and a coarse one is not round. Between the corners of a
// triangle over which normals turn by an angle of φ, light that is interpolated is short by some
// φ²/6 of it.
TEST(InterpolationError, NormalsCountWhereTheyAreAskedFor) {
  for (const int subdivisions : {2, 3}) {
    const scene::Scene scene = scene::sceneOf(scene::icosphere(1, subdivisions));
    const auto rays = trace::RayScene::build(scene);
    const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
    InterpolationErrorOptions options;
    const auto rms = [&] {
      const auto places = placeErrors(scene, *rays, *receivers, {true}, options, {});
      EXPECT_TRUE(places);
      double sum = 0.0;
      for (const PlaceError& place : *places) sum += *place.squared;
      return std::sqrt(std::max(0.0, sum / double(places->size())));
    };
    const double shadows = rms();
    options.withNormals = true;
    const double all = rms();
    EXPECT_LT(shadows, 0.5 * all);
    const double angle = 1.107 / std::pow(2.0, subdivisions);  // of an edge
    EXPECT_GT(all, 0.02 * angle * angle);
    EXPECT_LT(all, angle * angle);
  }
}

}  // namespace
}  // namespace lambent::macro
