// Surfaces that emit light, in the path tracer, against closed forms.
#include "lambent/reference/emitters.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/math/random.h"
#include "lambent/reference/path_tracer.h"
#include "lambent/scene/shapes.h"

namespace lambent::reference {
namespace {

scene::Material lamp(const Rgb& radiance) {
  scene::Material material;
  material.diffuse = Rgb::Zero();
  material.emission = radiance;
  return material;
}

scene::Material matt(const Rgb& albedo) {
  scene::Material material;
  material.diffuse = albedo;
  return material;
}

Probe facing(const Vec3& position, const Vec3& normal, const Rgb& albedo) {
  scene::SurfacePoint point;
  point.position = position;
  point.normal = point.geometricNormal = normal;
  point.diffuse = albedo;
  point.glossy = point.mirror = Rgb::Zero();
  point.lobeExponent = 16;
  return {point, normal};
}

/// Mean over 16 equal probes, all of them with errors of their own.
Estimate radiance(const scene::Scene& scene, const Probe& probe, int samples, int bounces,
                  const light::Environment& environment = {}) {
  const auto rays = trace::RayScene::build(scene);
  EXPECT_TRUE(rays);
  PathTraceOptions options;
  options.samples = samples;
  options.bounces = bounces;
  options.seed = 4;
  const std::vector<Probe> probes(16, probe);
  const auto estimates = exitRadiance(scene, *rays, environment, probes, options);
  EXPECT_TRUE(estimates);
  Estimate sum{Rgb::Zero(), Rgb::Zero()};
  for (const Estimate& e : *estimates) sum.mean += e.mean / 16, sum.variance += e.variance / 256;
  return sum;
}

void expectTruth(const Estimate& e, const Rgb& truth, double tessellation) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(e.mean[c], truth[c], 5 * std::sqrt(double(e.variance[c])) + tessellation) << c;
}

TEST(Emitters, AreDrawnByAreaAndEmission) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(1, 1, 2, 2), lamp(Rgb::Constant(6)));
  scene::addTo(scene, scene::translated(scene::gridPlane(2, 1, 1, 1), Vec3(9, 0, 0)),
               lamp(Rgb::Constant(1)));
  scene::addTo(scene, scene::translated(scene::gridPlane(5, 5, 1, 1), Vec3(-9, 0, 0)),
               matt(Rgb::Ones()));
  const Emitters emitters(scene);
  math::Random random(1, 0);
  int bright = 0;
  Vec3 mean = Vec3::Zero();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Emitters::Sample sample = emitters.sample(random.uniform2(), random.uniform());
    EXPECT_NEAR(sample.position.y(), 0, 1e-6);
    EXPECT_TRUE(sample.normal.isApprox(Vec3::UnitY(), 1e-5f));
    EXPECT_GT(sample.position.x(), -1);
    if (sample.emission.x() == 6) ++bright, mean += sample.position;
  }
  EXPECT_NEAR(double(bright) / count, 0.75, 5 * std::sqrt(0.75 * 0.25 / count));
  EXPECT_LT((mean / float(bright)).norm(), 0.02f);
  // 6 of 8 over an area of 1.
  EXPECT_NEAR(emitters.pdf(Rgb::Constant(6), 2, 0.5f), 6.0 / 8 * 4 / 0.5, 1e-5);
  EXPECT_TRUE(std::isinf(emitters.pdf(Rgb::Constant(6), 2, -0.5f)));
  EXPECT_TRUE(Emitters(scene::sceneOf(scene::gridPlane(1, 1, 1, 1))).empty());
}

// A sphere of radius r and radiance L at distance D, wholly above the horizon: E = π L (r/D)² cos
// θ.
TEST(Emitters, ASphereLightsAPlane) {
  const Rgb albedo(0.9f, 0.5f, 0.2f), light(3, 5, 7);
  for (const double degrees : {0.0, 30.0, 60.0})
    for (const double radius : {0.05, 0.8}) {
      const double theta = degrees * kPi / 180, distance = 2;
      const Vec3 center(float(distance * std::sin(theta)), float(distance * std::cos(theta)), 0);
      const scene::Scene scene = scene::sceneOf(
          scene::translated(scene::icosphere(float(radius), 5), center), lamp(light));
      const double share = std::cos(theta) * std::pow(radius / distance, 2);
      expectTruth(radiance(scene, facing(Vec3::Zero(), Vec3::UnitY(), albedo), 256, 0),
                  albedo * light * float(share), 1e-3 * share * 7);
    }
}

// Small lamps are found by drawing from them: the error bar is small though next to no path that
// follows the cosine would meet one.
TEST(Emitters, SmallLampsAreNotNoisy) {
  const scene::Scene scene = scene::sceneOf(
      scene::translated(scene::icosphere(0.02f, 3), Vec3(0, 2, 0)), lamp(Rgb::Constant(1e4f)));
  const Estimate e = radiance(scene, facing(Vec3::Zero(), Vec3::UnitY(), Rgb::Ones()), 256, 0);
  EXPECT_LT(std::sqrt(e.variance.x()) / e.mean.x(), 0.02f);
}

// Everything alike that emits e and reflects ρ: e / (1 − ρ), the furnace with its own fire.
TEST(Emitters, AFurnaceOfItsOwn) {
  scene::Material wall = matt(Rgb(0.5f, 0.25f, 0.8f));
  wall.emission = Rgb::Ones();
  const scene::Scene room = scene::sceneOf(scene::flipped(scene::icosphere(1, 4)), wall);
  Probe probe = facing(Vec3(0, -1, 0), Vec3::UnitY(), wall.diffuse);
  probe.point.emission = wall.emission;
  const Estimate e = radiance(room, probe, 256, 64);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(e.mean[c], 1 / (1 - wall.diffuse[c]), 0.01 / (1 - wall.diffuse[c]));
}

TEST(Emitters, HideAndAddToTheEnvironment) {
  const double share = 0.16;  // a sphere of radius 0.8 at distance 2, overhead
  const scene::Scene scene = scene::sceneOf(
      scene::translated(scene::icosphere(0.8f, 5), Vec3(0, 2, 0)), lamp(Rgb(2, 0, 1)));
  const Estimate e = radiance(scene, facing(Vec3::Zero(), Vec3::UnitY(), Rgb::Ones()), 1024, 0,
                              light::Environment::uniform(Rgb::Ones()));
  expectTruth(e, Rgb(1 + share, 1 - share, 1), 1e-3);
}

TEST(Emitters, LightByWayOfAMirror) {
  // A lamp behind the receiver's horizon, seen in a large mirror overhead.
  scene::Material mirror = matt(Rgb::Zero());
  mirror.mirror = Rgb::Constant(0.5f);
  scene::Scene scene;
  scene::addTo(scene,
               scene::translated(scene::flipped(scene::gridPlane(40, 40, 1, 1)), Vec3(0, 3, 0)),
               mirror);
  scene::addTo(scene, scene::translated(scene::icosphere(0.8f, 5), Vec3(2, -3, 0)),
               lamp(Rgb::Ones()));
  // Its image is at (2, 9, 0).
  const double distance2 = 4 + 81, share = 0.5 * 0.64 / distance2 * 9 / std::sqrt(distance2);
  const Estimate e = radiance(scene, facing(Vec3::Zero(), Vec3::UnitY(), Rgb::Ones()), 8192, 0);
  expectTruth(e, Rgb::Constant(float(share)), 2e-3 * share);
}

TEST(Emitters, ShowTheirFrontsToACamera) {
  scene::Scene scene = scene::sceneOf(scene::gridPlane(2, 2, 1, 1), lamp(Rgb(3, 2, 1)));
  const auto rays = trace::RayScene::build(scene);
  ASSERT_TRUE(rays);
  PathTraceOptions options;
  options.samples = 4;
  scene::Camera camera;
  camera.orthographicHalfHeight = 0.5f;
  for (const bool front : {true, false}) {
    camera.worldFromCamera.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, front ? 1 : -1, 0,
        front ? -1 : 1, 0;
    camera.worldFromCamera(1, 3) = front ? 1 : -1;
    const auto picture = reference::picture(scene, *rays, {}, camera, 2, 2, options);
    ASSERT_TRUE(picture);
    const Rgb expected = front ? Rgb(3, 2, 1) : Rgb::Zero();
    EXPECT_TRUE(picture->mean.at(0, 0).isApprox(expected, 1e-6f)) << front;
    EXPECT_EQ(picture->mean.alpha[0], 1);
  }
}

}  // namespace
}  // namespace lambent::reference
