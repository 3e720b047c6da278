// Paths around surfaces with two sides.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/reference/path_tracer.h"
#include "lambent/reference/test_statistics.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"

namespace lambent::reference {
namespace {

trace::RayScene raysOf(const scene::Scene& scene) {
  auto rays = trace::RayScene::build(scene);
  EXPECT_TRUE(rays);
  return std::move(*rays);
}

scene::Camera cameraFrom(const Vec3& eye) {
  scene::Camera camera;
  const Vec3 back = eye.normalized();
  const Vec3 right = Vec3(0.1f, 0.2f, 1.0f).cross(back).normalized();
  camera.worldFromCamera.col(0).head<3>() = right;
  camera.worldFromCamera.col(1).head<3>() = back.cross(right);
  camera.worldFromCamera.col(2).head<3>() = back;
  camera.worldFromCamera.col(3).head<3>() = eye;
  camera.verticalFov = 0.3f;
  return camera;
}

TEST(TwoSides, ASheetIsSeenInItsAlbedoFromBothSides) {
  scene::Scene scene = scene::sceneOf(scene::withBacks(scene::gridPlane(4, 4, 2, 2)));
  scene.materials[0].diffuse = Rgb(0.9f, 0.5f, 0.2f);
  const trace::RayScene rays = raysOf(scene);
  for (const float side : {1.0f, -1.0f}) {
    const auto seen = picture(scene, rays, light::Environment::uniform(Rgb::Ones()),
                              cameraFrom(Vec3(0.5f, 3 * side, 0.4f)), 16, 16, {.samples = 64});
    ASSERT_TRUE(seen);
    Rgb mean = Rgb::Zero();
    for (const Rgb& pixel : seen->mean.pixels) mean += pixel / 256.0f;
    EXPECT_TRUE(mean.isApprox(scene.materials[0].diffuse, 5e-3f)) << side << ": " << mean;
  }
}

// A bake and the paths around the same veils, holes and panes converge to the same: what the ground
// below half a veil gets, by both ways of finding light.
TEST(Coverage, PathsComeThroughVeilsAndPanes) {
  scene::Scene scene;
  scene::Material ground, veil;
  ground.diffuse = Rgb::Constant(0.5f);
  veil.diffuse = Rgb::Constant(0.6f);
  veil.alphaMode = scene::AlphaMode::Blend;
  veil.opacity = 0.5f;
  scene::addTo(scene, scene::gridPlane(0.01f, 0.01f, 1, 1), ground);
  scene::addTo(scene,
               scene::withBacks(scene::translated(scene::gridPlane(4, 4, 1, 1), Vec3(0, 1, 0))),
               veil);
  const double along = 2 / std::sqrt(5.0), factor = 4 / kPi * along * std::atan(along);
  const auto groundUnder = [&](int bounces) {
    const trace::RayScene rays = raysOf(scene);
    std::vector<Probe> probes;
    for (std::uint32_t v = 0; v < 4; ++v) {
      const scene::SurfacePoint point = scene::surfaceAtVertex(scene, 0, v);
      probes.push_back({point, point.normal});
    }
    const auto got = exitRadiance(scene, rays, light::Environment::uniform(Rgb::Ones()), probes,
                                  {.samples = 4096, .bounces = bounces});
    EXPECT_TRUE(got);
    Estimate sum{Rgb::Zero(), Rgb::Zero()};
    for (const Estimate& each : *got) sum.mean += each.mean / 4, sum.variance += each.variance / 16;
    return sum;
  };
  const auto expect = [](const Estimate& got, const Rgb& right) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(got.mean[c], right[c], kLargestZ * std::sqrt(got.variance[c]) + 1e-4);
  };
  const auto hidden = float(0.5 * factor);
  expect(groundUnder(0), Rgb::Constant(0.5f * (1 - hidden)));
  // The underside sees the lower hemisphere, all sky.
  expect(groundUnder(1), Rgb::Constant(0.5f * (1 - hidden + hidden * 0.6f)));
  scene.materials[1].alphaMode = scene::AlphaMode::Opaque;
  scene.materials[1].diffuse = Rgb::Zero();
  scene.materials[1].transmitted = Rgb(0.9f, 0.5f, 0.1f);
  expect(groundUnder(0), 0.5f * (1 - float(factor) * (1 - scene.materials[1].transmitted)));
}

// As an emitter of two sides: what a small square below a large sheet gets from it.
TEST(TwoSides, BothSidesOfALampShine) {
  scene::Scene scene;
  scene::Material lamp;
  lamp.diffuse = Rgb::Zero();
  lamp.emission = Rgb(3, 2, 1);
  scene::addTo(scene, scene::withBacks(scene::gridPlane(2, 2, 1, 1)), lamp);
  const trace::RayScene rays = raysOf(scene);
  std::vector<Probe> probes;
  for (const float side : {1.0f, -1.0f}) {
    scene::SurfacePoint point;
    point.position = Vec3(0, 0.5f * side, 0);
    point.normal = point.geometricNormal = Vec3(0, -side, 0);
    point.diffuse = Rgb::Ones();
    point.glossy = point.mirror = Rgb::Zero();
    probes.push_back({point, point.normal});
  }
  const auto got = exitRadiance(scene, rays, light::Environment::uniform(Rgb::Zero()), probes,
                                {.samples = 4096, .bounces = 1});
  ASSERT_TRUE(got);
  // Four quarters of a square of side 1 seen from 1/2 below its corner (Howell's B-4).
  const double x = 2.0, along = x / std::sqrt(1 + x * x);
  const double quarter = 1 / (2 * kPi) * 2 * along * std::atan(x / std::sqrt(1 + x * x));
  for (const Estimate& each : *got)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(each.mean[c], 4 * quarter * lamp.emission[c],
                  kLargestZ * std::sqrt(each.variance[c]) + 1e-4);
}

}  // namespace
}  // namespace lambent::reference
