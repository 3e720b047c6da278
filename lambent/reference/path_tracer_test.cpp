// The path tracer against closed forms, by z-tests on its own error bars.
#include "lambent/reference/path_tracer.h"

#include <cmath>
#include <cstring>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/statistics.h"
#include "lambent/reference/test_statistics.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/basis.h"
#include "lambent/sh/zonal.h"
#include "lambent/shade/test_air.h"

namespace lambent::reference {
namespace {

using light::Environment;

constexpr int kMany = 1 << 20;  ///< bounces: all of them

scene::Material diffuseMaterial(const Rgb& albedo) {
  scene::Material material;
  material.diffuse = albedo;
  return material;
}
scene::Material mirrorMaterial(const Rgb& reflectance) {
  scene::Material material;
  material.diffuse = Rgb::Zero();
  material.mirror = reflectance;
  return material;
}

struct World {
  scene::Scene scene;
  trace::RayScene rays;
  explicit World(scene::Scene s) : scene(std::move(s)), rays(build(scene)) {}

 private:
  static trace::RayScene build(const scene::Scene& s) {
    Result<trace::RayScene> rays = trace::RayScene::build(s);
    EXPECT_TRUE(rays) << rays.error().message;
    return std::move(*rays);
  }
};

/// A scene that is far below and of no effect, for receivers that see the whole sky.
World emptyWorld() {
  return World(scene::sceneOf(scene::translated(scene::icosphere(0.01f, 0), Vec3(0, -100, 0))));
}

scene::SurfacePoint receiver(const Vec3& position, const Vec3& normal, const Rgb& diffuse) {
  scene::SurfacePoint point;
  point.position = position;
  point.normal = point.geometricNormal = normal.normalized();
  point.diffuse = diffuse;
  point.glossy = point.mirror = Rgb::Zero();
  point.lobeExponent = 16;
  return point;
}
Probe facing(const scene::SurfacePoint& point) {
  return {point, point.normal};
}

std::vector<Estimate> trace(const World& world, const Environment& light,
                            const std::vector<Probe>& probes, int samples, int bounces,
                            std::uint64_t seed = 1) {
  PathTraceOptions options;
  options.samples = samples;
  options.bounces = bounces;
  options.seed = seed;
  auto estimates = exitRadiance(world.scene, world.rays, light, probes, options);
  EXPECT_TRUE(estimates) << estimates.error().message;
  return std::move(*estimates);
}

/// The mean over independent probes that have the same truth.
Estimate together(const std::vector<Estimate>& estimates) {
  Estimate sum{Rgb::Zero(), Rgb::Zero()};
  for (const Estimate& e : estimates) {
    sum.mean += e.mean;
    sum.variance += e.variance;
  }
  const float n = float(estimates.size());
  return {sum.mean / n, sum.variance / (n * n)};
}

/// |mean − truth| within five standard errors and what tessellation may do.
void expectTruth(const Estimate& e, const Rgb& truth, const std::string& what = "",
                 double tessellation = 0) {
  for (int c = 0; c < 3; ++c) {
    const double error = std::sqrt(double(e.variance[c])) + 1e-6 * (1 + double(truth[c]));
    EXPECT_LT(std::abs(double(e.mean[c]) - double(truth[c])), kLargestZ * error + tessellation)
        << what << " channel " << c << ": " << e.mean[c] << " ± " << error << ", truth "
        << truth[c];
  }
}

TEST(Furnace, AConvexBodyReturnsItsAlbedo) {
  const Rgb albedo(1, 0.5f, 0.2f);
  const World world(scene::sceneOf(scene::icosphere(1, 2), diffuseMaterial(albedo)));
  std::vector<Probe> probes;
  for (std::uint32_t v = 0; v < world.scene.meshes[0].positions.size(); ++v)
    probes.push_back(facing(scene::surfaceAtVertex(world.scene, 0, v)));
  const auto estimates = trace(world, Environment::uniform(Rgb::Ones()), probes, 64, kMany);
  for (const Estimate& e : estimates) expectTruth(e, albedo, "vertex");
  expectTruth(together(estimates), albedo, "together");
}

TEST(Furnace, AClosedRoomIsDark) {
  const World world(scene::sceneOf(scene::room(Vec3::Constant(2)), diffuseMaterial(Rgb::Ones())));
  std::vector<Probe> probes;
  for (std::uint32_t v = 0; v < world.scene.meshes[0].positions.size(); ++v)
    probes.push_back(facing(scene::surfaceAtVertex(world.scene, 0, v)));
  for (std::uint32_t t = 0; t < world.scene.meshes[0].triangles.size(); ++t)
    probes.push_back(facing(scene::surfaceAt(world.scene, 0, t, 0.3f, 0.3f)));
  const Environment sky = Environment::uniform(Rgb::Ones());
  const auto estimates = trace(world, sky, probes, 64, 8);
  // Interior points are lifted off the walls and see nothing but walls. A corner's own lift does
  // not leave the two other walls: it may see out.
  for (std::size_t i = world.scene.meshes[0].positions.size(); i < probes.size(); ++i)
    EXPECT_EQ(estimates[i].mean.maxCoeff(), 0);
}

// A patch of a sphere that covers the fraction s of its area: every point has ρ(1−s)(ρs)^b from
// bounce b.
TEST(Bowl, EveryBounceIsAGeometricSeries) {
  constexpr int kSlices = 256;
  const double facet = 2 * kPi / kSlices;
  for (const double s : {0.5, 0.8}) {
    const Rgb albedo(0.5f, 0.9f, 0.2f);
    const World world(
        scene::sceneOf(scene::bowl(1, float(s), kSlices, kSlices / 2), diffuseMaterial(albedo)));
    math::Random random(3, 0);
    std::vector<Probe> probes;
    for (int n = 0; n < 64; ++n) {
      const auto triangle = random.below(std::uint32_t(world.scene.meshes[0].triangles.size()));
      const float a = random.uniform(), b = random.uniform();
      probes.push_back(
          facing(scene::surfaceAt(world.scene, 0, triangle, std::min(a, b), 1 - std::max(a, b))));
    }
    for (const int bounces : {0, 1, 2, kMany}) {
      Rgb truth;
      for (int c = 0; c < 3; ++c) {
        const double rho = albedo[c];
        truth[c] = float(bounces == kMany ? rho * (1 - s) / (1 - rho * s)
                                          : rho * (1 - s) * (1 - std::pow(rho * s, bounces + 1)) /
                                                (1 - rho * s));
      }
      const auto estimates = trace(world, Environment::uniform(Rgb::Ones()), probes, 1024, bounces);
      expectTruth(together(estimates), truth,
                  "s " + std::to_string(s) + ", bounces " + std::to_string(bounces), facet * facet);
    }
  }
}

TEST(DirectLight, ShadowOfASphere) {
  constexpr int kSubdivisions = 5;
  const double facet = 1.1 / (1 << kSubdivisions);  // edge of the subdivided icosahedron
  for (const double degrees : {0.0, 30.0, 55.0}) {
    const double theta = degrees * kPi / 180, r = 1, d = 2;
    const Vec3 centre(float(d * std::sin(theta)), float(d * std::cos(theta)), 0);
    const World world(
        scene::sceneOf(scene::translated(scene::icosphere(float(r), kSubdivisions), centre),
                       diffuseMaterial(Rgb::Ones())));
    const std::vector<Probe> probes(
        16, facing(receiver(Vec3::Zero(), Vec3::UnitY(), Rgb(1, 0.5f, 0.25f))));
    const double seen = 1 - std::cos(theta) * (r / d) * (r / d);
    const auto estimates = trace(world, Environment::uniform(Rgb::Ones()), probes, 1024, 0);
    expectTruth(together(estimates), float(seen) * Rgb(1, 0.5f, 0.25f),
                std::to_string(degrees) + " degrees", facet * facet / 4);
  }
}

TEST(DirectLight, DiscDirectionalAndHarmonics) {
  const World world = emptyWorld();
  const Vec3 normal = Vec3(0.2f, 1, 0.3f).normalized();
  const Rgb albedo(0.9f, 0.5f, 0.1f);
  const std::vector<Probe> probes(8, facing(receiver(Vec3::Zero(), normal, albedo)));
  const Vec3 towards = Vec3(0.5f, 0.7f, -0.1f).normalized();
  const double cosine = double(normal.dot(towards));

  for (const double degrees : {0.53, 30.0, 60.0}) {
    // A disc above the horizon: E = L π sin² α cos θ.
    const double alpha = degrees / 2 * kPi / 180;
    const Environment disc = Environment::disc(towards, 2 * alpha, Rgb(1, 2, 3));
    const double share = std::sin(alpha) * std::sin(alpha) * cosine;
    expectTruth(together(trace(world, disc, probes, 256, 2)), albedo * Rgb(1, 2, 3) * float(share),
                "disc");
  }
  const Environment directional = Environment::directional(towards, Rgb(1, 2, 3));
  expectTruth(together(trace(world, directional, probes, 64, 2)),
              albedo * Rgb(1, 2, 3) * float(cosine / kPi), "directional");

  sh::RgbCoefficients f(5);
  math::Random random(8, 0);
  for (float& value : f.values) value = random.uniform() - 0.5f;
  sh::RgbCoefficients convolved = f;
  for (int c = 0; c < 3; ++c) sh::convolve(sh::clampedCosine(5), convolved.channel(c));
  const Rgb truth = albedo / float(kPi) * sh::reconstruct(convolved, normal);
  expectTruth(together(trace(world, Environment::harmonics(f), probes, 1024, 2)), truth,
              "harmonics");
  const Environment sum = Environment::harmonics(f) + directional;
  expectTruth(together(trace(world, sum, probes, 1024, 2)),
              truth + albedo * Rgb(1, 2, 3) * float(cosine / kPi), "sum");
}

TEST(DirectLight, AnImageGivesTheIrradianceOfItsHarmonics) {
  // The clamped cosine has bands beyond ten, but they are small: −π/24 at l = 4, .0018 at l = 10.
  image::Image image(16, 8);
  math::Random random(9, 0);
  for (Rgb& p : image.pixels)
    p = Rgb(random.uniform(), random.uniform(), random.uniform()) *
        (random.uniform() < 0.05f ? 40.0f : 1.0f);
  const Environment light = Environment::latLong(image);
  sh::RgbCoefficients convolved = light.project(10);
  for (int c = 0; c < 3; ++c) sh::convolve(sh::clampedCosine(10), convolved.channel(c));
  const World world = emptyWorld();
  double total = 0;
  for (const Rgb& p : image.pixels) total += double(p[1]) / double(image.pixels.size());
  for (int n = 0; n < 6; ++n) {
    const Vec3 normal = math::uniformSphere(random.uniform2());
    const std::vector<Probe> probes(8, facing(receiver(Vec3::Zero(), normal, Rgb::Ones())));
    expectTruth(together(trace(world, light, probes, 1024, 2)),
                sh::reconstruct(convolved, normal) / float(kPi), "image", 0.01 * total);
  }
}

TEST(Glossy, TheLobeConvolvesTheLight) {
  const World world = emptyWorld();
  const Vec3 normal = Vec3(-0.2f, 0.4f, 0.9f).normalized();
  sh::RgbCoefficients f(6);
  math::Random random(10, 0);
  for (float& value : f.values) value = random.uniform() - 0.5f;
  for (const float exponent : {1.0f, 4.0f, 64.0f, 1000.0f}) {
    scene::SurfacePoint point = receiver(Vec3::Zero(), normal, Rgb::Zero());
    point.glossy = Rgb(0.9f, 0.6f, 0.3f);
    point.lobeExponent = exponent;
    // Seen along the normal the lobe's hemisphere is the surface's.
    sh::RgbCoefficients convolved = f;
    for (int c = 0; c < 3; ++c) sh::convolve(sh::phongLobe(6, exponent), convolved.channel(c));
    const std::vector<Probe> probes(8, facing(point));
    expectTruth(together(trace(world, Environment::harmonics(f), probes, 1024, 2)),
                point.glossy * sh::reconstruct(convolved, normal), std::to_string(exponent));
    // In uniform light the lobe's unit integral is all there is.
    expectTruth(together(trace(world, Environment::uniform(Rgb::Ones()), probes, 256, 2)),
                point.glossy, "furnace");
  }
  // From the side: a narrow lobe looks where a mirror would.
  scene::SurfacePoint point = receiver(Vec3::Zero(), normal, Rgb::Zero());
  point.glossy = Rgb::Ones();
  point.lobeExponent = 4000;
  const Vec3 viewer = (normal + 0.6f * Vec3::UnitX()).normalized();
  const Vec3 away = math::reflectAbout(viewer, normal);
  sh::RgbCoefficients convolved = f;
  for (int c = 0; c < 3; ++c) sh::convolve(sh::phongLobe(6, 4000), convolved.channel(c));
  expectTruth(together(trace(world, Environment::harmonics(f),
                             std::vector<Probe>(8, Probe{point, viewer}), 256, 2)),
              sh::reconstruct(convolved, away), "from the side");
}

// A glossy wall seen by way of a diffuse receiver: what the wall sends back is k · the lobe about
// the mirrored direction, which in a sky of one radiance is k wherever the lobe sees only sky.
TEST(Glossy, AWallSendsLightToAReceiver) {
  scene::Material wall;
  wall.diffuse = Rgb::Zero();
  wall.glossy = Rgb(0.8f, 0.5f, 0.2f);
  wall.lobeExponent = 2000;
  // The receiver looks down at a wide glossy floor; nothing else shines from below.
  const World world(scene::sceneOf(scene::gridPlane(2, 2, 1, 1), wall));
  const Environment upper = Environment::disc(Vec3::UnitY(), kPi, Rgb::Ones());
  const std::vector<Probe> probes(16, facing(receiver(Vec3(0, 1, 0), -Vec3::UnitY(), Rgb::Ones())));
  // Form factor of a square of half width a at distance h: 4 · the corner factor.
  const double a = 1, q = a / std::sqrt(1 + a * a);
  const double form = 4 / (2 * kPi) * 2 * q * std::atan(q);
  const auto glossy = together(trace(world, upper, probes, 4096, 1));
  // The lobe's tail below the wall's own horizon is lost: nothing at these angles (≥ 35°).
  expectTruth(glossy, wall.glossy * float(form), "one bounce");
  expectTruth(together(trace(world, upper, probes, 256, 0)), Rgb::Zero(), "no bounce");
}

TEST(Mirror, AFloorIsNoBounce) {
  const World world(
      scene::sceneOf(scene::gridPlane(2, 2, 1, 1), mirrorMaterial(Rgb(0.8f, 0.5f, 0.2f))));
  const Environment upper = Environment::disc(Vec3::UnitY(), kPi, Rgb::Ones());
  const std::vector<Probe> probes(16, facing(receiver(Vec3(0, 1, 0), -Vec3::UnitY(), Rgb::Ones())));
  const double q = 1 / std::sqrt(2.0);
  const double form = 4 / (2 * kPi) * 2 * q * std::atan(q);
  expectTruth(together(trace(world, upper, probes, 4096, 0)), Rgb(0.8f, 0.5f, 0.2f) * float(form));
}

/// Two mirrors at 45°: who looks along −x at the origin looks along −x from (0, 2, 0).
scene::Scene periscope() {
  scene::Scene scene;
  const float quarter = float(kPi / 4);
  scene::addTo(scene, scene::rotated(scene::gridPlane(1, 1, 2, 2), Vec3::UnitZ(), -quarter),
               mirrorMaterial(Rgb(0.9f, 0.8f, 0.7f)));
  scene::addTo(scene,
               scene::translated(scene::rotated(scene::gridPlane(1, 1, 2, 2), Vec3::UnitZ(),
                                                float(kPi) - quarter),
                                 Vec3(0, 2, 0)),
               mirrorMaterial(Rgb(0.5f, 0.6f, 0.7f)));
  return scene;
}

TEST(Mirror, PeriscopeShowsTheSky) {
  const World world(periscope());
  math::Random random(4, 0);
  sh::RgbCoefficients f(4);
  for (float& value : f.values) value = random.uniform() - 0.5f;
  const Environment sky = Environment::harmonics(f);
  scene::SurfacePoint point = scene::surfaceAtVertex(world.scene, 0, 4);
  ASSERT_LT(point.position.norm(), 1e-6f);
  ASSERT_GT(point.normal.x(), 0.7f);
  const Rgb tint = Rgb(0.9f, 0.8f, 0.7f) * Rgb(0.5f, 0.6f, 0.7f);
  const auto seen = trace(world, sky, {{point, Vec3::UnitX()}}, 32, 0);
  EXPECT_TRUE(seen[0].mean.isApprox(tint * sky.radiance(-Vec3::UnitX()), 1e-4f))
      << seen[0].mean.transpose();
  EXPECT_LT(seen[0].variance.maxCoeff(), 1e-10f);
}

TEST(Mirror, PeriscopeShowsAWallAndStopsAtABack) {
  const Rgb albedo(0.3f, 0.6f, 0.9f), tint = Rgb(0.9f, 0.8f, 0.7f) * Rgb(0.5f, 0.6f, 0.7f);
  const Environment sky = Environment::uniform(Rgb::Ones());
  for (const float side : {-1.0f, 1.0f}) {
    scene::Scene scene = periscope();
    // A small wall far off at the end of the view: it sees almost nothing of the mirrors.
    scene::addTo(scene,
                 scene::translated(scene::rotated(scene::gridPlane(1, 1, 1, 1), Vec3::UnitZ(),
                                                  side * float(kPi / 2)),
                                   Vec3(-50, 2, 0)),
                 diffuseMaterial(albedo));
    const World world(scene);
    const auto point = scene::surfaceAtVertex(world.scene, 0, 4);
    const std::vector<Probe> probes(8, Probe{point, Vec3::UnitX()});
    const Estimate seen = together(trace(world, sky, probes, 256, 0));
    // rotation by −90° about z turns +y to +x: the front looks at the mirror.
    const double blocked = 1.0 / (kPi * 50 * 50);  // at most the form factor of a mirror
    if (side < 0)
      expectTruth(seen, tint * albedo, "front", blocked);
    else
      expectTruth(seen, Rgb::Zero(), "back");
  }
}

TEST(Mirror, AHallOfMirrorsEnds) {
  const World world(scene::sceneOf(scene::room(Vec3(2, 2, 2)), mirrorMaterial(Rgb::Ones())));
  const std::vector<Probe> probes = {
      facing(receiver(Vec3(0.1f, 0.2f, 0.3f), Vec3::UnitY(), Rgb::Ones()))};
  const auto seen = trace(world, Environment::uniform(Rgb::Ones()), probes, 64, 3);
  EXPECT_EQ(seen[0].mean.maxCoeff(), 0);
}

TEST(Options, WithoutShadowsOnlyTheLightCounts) {
  const World world(scene::sceneOf(scene::translated(scene::icosphere(1, 3), Vec3(0, 2, 0))));
  const std::vector<Probe> probes(8, facing(receiver(Vec3::Zero(), Vec3::UnitY(), Rgb::Ones())));
  PathTraceOptions options;
  options.shadows = false;
  const auto seen =
      exitRadiance(world.scene, world.rays, Environment::uniform(Rgb::Ones()), probes, options);
  ASSERT_TRUE(seen);
  expectTruth(together(*seen), Rgb::Ones());
}

TEST(Options, WithoutShadowsALobeSeesTheWholeSphere) {
  // T_GU convolves the whole sphere: seen at grazing angle, half the lobe lies below the surface.
  scene::SurfacePoint point = receiver(Vec3::Zero(), Vec3::UnitY(), Rgb::Zero());
  point.glossy = Rgb::Ones(), point.lobeExponent = 4.0f;
  const World world = emptyWorld();
  const std::vector<Probe> probes(8, Probe{point, Vec3(1, 0, 0)});
  for (const bool shadows : {true, false}) {
    PathTraceOptions options;
    options.shadows = shadows, options.samples = 1024, options.bounces = 0;
    const auto seen =
        exitRadiance(world.scene, world.rays, Environment::uniform(Rgb::Ones()), probes, options);
    ASSERT_TRUE(seen);
    expectTruth(together(*seen), Rgb::Constant(shadows ? 0.5f : 1.0f));
  }
}

TEST(Options, ThatMakeNoSenseAreRefused) {
  const World world = emptyWorld();
  const auto kind = [&](PathTraceOptions options, int width) {
    const auto result =
        picture(world.scene, world.rays, Environment(), scene::Camera(), width, 4, options);
    return result ? -1 : int(result.error().kind);
  };
  EXPECT_EQ(kind({.samples = 0}, 4), int(ErrorKind::BadUsage));
  EXPECT_EQ(kind({.bounces = -1}, 4), int(ErrorKind::BadUsage));
  EXPECT_EQ(kind({}, 0), int(ErrorKind::BadUsage));
  EXPECT_EQ(kind({}, 1 << 20), int(ErrorKind::BadUsage));
  EXPECT_EQ(kind({}, 4), -1);
}

// The error bars are honest: (mean − truth)²/variance averages to that of Student's t, ν/(ν−2).
TEST(Variance, IsThatOfTheMean) {
  const World world = emptyWorld();
  const Vec3 normal = Vec3::UnitY();
  const Environment light = Environment::disc(Vec3(1, 1, 0).normalized(), 1.0, Rgb::Ones()) +
                            Environment::uniform(Rgb::Constant(0.2f));
  const double truth =
      0.2 + std::sin(0.5) * std::sin(0.5) * std::cos(kPi / 4);  // a disc above the horizon
  constexpr int kProbes = 2000;
  const std::vector<Probe> probes(kProbes, facing(receiver(Vec3::Zero(), normal, Rgb::Ones())));
  double variancePerPath[2] = {};
  for (const int samples : {16, 256}) {
    math::RunningMoments squares;
    for (const Estimate& e : trace(world, light, probes, samples, 0)) {
      const double z2 = std::pow(double(e.mean[0]) - truth, 2) / double(e.variance[0]);
      squares.add(z2);
      variancePerPath[samples == 256] += double(e.variance[0]) * samples / kProbes;
    }
    EXPECT_LT(std::abs(squares.mean() - 15.0 / 13) / squares.standardError(), kLargestZ) << samples;
  }
  // And stratification within batches earns its keep.
  EXPECT_LT(variancePerPath[1], 0.5 * variancePerPath[0]);
}

TEST(Variance, OfASinglePathIsUnknown) {
  const World world = emptyWorld();
  const auto e = trace(world, Environment::uniform(Rgb::Ones()),
                       {facing(receiver(Vec3::Zero(), Vec3::UnitY(), Rgb::Ones()))}, 1, 0);
  EXPECT_TRUE(std::isinf(e[0].variance[0]));
}

scene::Camera frontCamera() {
  scene::Camera camera;
  camera.worldFromCamera = Mat4::Identity();
  camera.worldFromCamera(2, 3) = 5;  // at z = 5, looking along −z
  camera.orthographicHalfHeight = 2.0f;
  return camera;
}

TEST(Picture, CoverageAndBackground) {
  const World world(scene::sceneOf(scene::icosphere(1, 5), diffuseMaterial(Rgb::Ones())));
  const Environment sky = Environment::uniform(Rgb(0.5f, 1, 2));
  PathTraceOptions options;
  options.samples = 64;
  const auto cut = picture(world.scene, world.rays, sky, frontCamera(), 32, 32, options);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->mean.alpha.size(), 32u * 32u);
  EXPECT_EQ(cut->mean.alpha[0], 0);
  EXPECT_EQ(cut->mean.pixels[0].maxCoeff(), 0);
  EXPECT_EQ(cut->mean.alpha[16 * 32 + 16], 1);
  double area = 0;
  for (const float a : cut->mean.alpha) area += double(a) / (32 * 32);
  EXPECT_NEAR(area, kPi / 16, 1e-3);

  options.background = true;
  const auto full = picture(world.scene, world.rays, sky, frontCamera(), 32, 32, options);
  ASSERT_TRUE(full);
  EXPECT_TRUE(full->mean.alpha.empty());
  EXPECT_TRUE(full->mean.at(0, 0).isApprox(Rgb(0.5f, 1, 2), 1e-5f));
  EXPECT_EQ(full->variance.at(0, 0).maxCoeff(), 0);
}

// A ball in a furnace, under a layer that is half there.
TEST(Picture, ShowsLayersAsFarAsTheyAreThere) {
  scene::Scene scene = scene::sceneOf(scene::icosphere(1, 4), diffuseMaterial(Rgb::Constant(0.8f)));
  scene::Mesh layer = scene.meshes[0];
  layer.layer = true;
  layer.material = 1;
  scene.meshes.push_back(std::move(layer));
  scene::Material& half = scene.materials.emplace_back(diffuseMaterial(Rgb(0.2f, 0.6f, 0.8f)));
  half.alphaMode = scene::AlphaMode::Blend;
  half.opacity = 0.5f;
  const World world(std::move(scene));
  PathTraceOptions options;
  options.samples = 64;
  const Environment sky = Environment::uniform(Rgb::Ones());
  const auto made = picture(world.scene, world.rays, sky, frontCamera(), 32, 32, options);
  ASSERT_TRUE(made);
  Rgb mean = Rgb::Zero();
  for (int y = 12; y < 20; ++y)
    for (int x = 12; x < 20; ++x) mean += made->mean.at(x, y) / 64.0f;
  EXPECT_LT((mean - Rgb(0.5f, 0.7f, 0.8f)).abs().maxCoeff(), 0.02f) << mean.transpose();
  EXPECT_EQ(made->mean.alpha[16 * 32 + 16], 1);
}

TEST(Picture, HasTheSameBytesForAnyNumberOfThreads) {
  scene::Scene scene = periscope();
  scene::Material glossy;
  glossy.glossy = Rgb::Constant(0.3f);
  scene::addTo(scene, scene::translated(scene::icosphere(0.6f, 2), Vec3(0.8f, 0.8f, 0)), glossy);
  const World world(scene);
  const Environment light =
      Environment::disc(Vec3::UnitY(), 1, Rgb::Ones()) + Environment::uniform(Rgb::Constant(0.3f));
  std::vector<Picture> pictures;
  for (const int threads : {1, 2, 5}) {
    PathTraceOptions options;
    options.samples = 32;
    options.bounces = 6;
    options.threads = threads;
    options.background = true;
    auto one = picture(world.scene, world.rays, light, frontCamera(), 40, 30, options);
    ASSERT_TRUE(one);
    pictures.push_back(std::move(*one));
  }
  for (std::size_t k = 1; k < pictures.size(); ++k) {
    const std::size_t bytes = pictures[0].mean.pixels.size() * sizeof(Rgb);
    EXPECT_EQ(std::memcmp(pictures[0].mean.pixels.data(), pictures[k].mean.pixels.data(), bytes),
              0);
    EXPECT_EQ(
        std::memcmp(pictures[0].variance.pixels.data(), pictures[k].variance.pixels.data(), bytes),
        0);
  }
  for (const Rgb& p : pictures[0].mean.pixels) ASSERT_TRUE(p.isFinite().all() && (p >= 0).all());
}

TEST(Picture, TellsItsProgressAndStops) {
  const World world(scene::sceneOf(scene::icosphere(1, 2)));
  const Environment sky = Environment::uniform(Rgb::Ones());
  PathTraceOptions options;
  options.samples = 4;
  std::uint64_t last = 0;
  const auto whole = picture(world.scene, world.rays, sky, frontCamera(), 32, 32, options,
                             [&](const ProgressUpdate& update) {
                               EXPECT_GE(update.done, last);
                               EXPECT_EQ(update.total, 32u * 32u);
                               EXPECT_EQ(update.unit, "pixels");
                               last = update.done;
                               return true;
                             });
  ASSERT_TRUE(whole);
  EXPECT_EQ(last, 32u * 32u);
  const auto stopped = picture(world.scene, world.rays, sky, frontCamera(), 32, 32, options,
                               [](const ProgressUpdate&) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(int(stopped.error().kind), int(ErrorKind::Cancelled));
}

/// A picture of a few pixels, from 20 m up.
Picture seenOver(const World& world, const Environment& light, const PathTraceOptions& options) {
  scene::Camera camera;
  camera.verticalFov = 0.2f;
  camera.worldFromCamera.topRightCorner<3, 1>() = Vec3(0, 20, 0);
  auto picture = reference::picture(world.scene, world.rays, light, camera, 12, 12, options);
  EXPECT_TRUE(picture) << picture.error().message;
  return std::move(*picture);
}

Vec3 lookedAt(int x, int y) {
  scene::Camera camera;
  camera.verticalFov = 0.2f;
  return scene::cameraRay(camera, 12, 12, float(x) + 0.5f, float(y) + 0.5f).direction;
}

TEST(AirBefore, LiesBeforeSurfacesAndTheGroundBehind) {
  // A wall 6 km away covers the right half, and the left half is the environment.
  scene::Scene walls;
  scene::Mesh wall = scene::gridPlane(8000, 8000, 1, 1);
  const Mat3 upright = Eigen::AngleAxisf(float(kPi) / 2, Vec3::UnitX()).toRotationMatrix();
  for (Vec3& p : wall.positions) p = upright * p + Vec3(4000, 0, -6000);
  for (Vec3& n : wall.normals) n = upright * n;
  scene::addTo(walls, wall, diffuseMaterial(Rgb(0.8f, 0.5f, 0.3f)));
  const World world(std::move(walls));
  const Environment light = Environment::uniform(Rgb(10, 20, 30));
  PathTraceOptions options;
  options.background = true;
  options.bounces = 0;
  const Picture without = seenOver(world, light, options);
  options.air = shade::test::clearAir();
  const Picture with = seenOver(world, light, options);
  for (int y = 0; y < 12; ++y)
    for (const int x : {2, 9}) {
      const bool behind = x == 2;
      if (behind && (y == 5 || y == 6)) continue;  // the horizon runs through these pixels
      const Vec3 direction = lookedAt(x, y);
      const Rgb before = without.mean.at(x, y);
      const Rgb expected = behind ? options.air->seenBehind(Vec3(0, 20, 0), direction, before)
                                  : options.air->seen(direction, 6000 / -direction.z(), before);
      // Air is not linear over a pixel of the ground.
      const float apart = (with.mean.at(x, y) - expected).abs().maxCoeff();
      EXPECT_LT(apart, (behind ? 0.05f : 0.02f) * expected.maxCoeff()) << x << ' ' << y;
      if (!behind) {
        EXPECT_GT((with.mean.at(x, y) - before).abs().maxCoeff(), 0.1f);
      }
    }
  scene::Camera camera;
  camera.orthographicHalfHeight = 5.0f;
  EXPECT_FALSE(reference::picture(world.scene, world.rays, light, camera, 2, 2, options));
}

TEST(AirBefore, MirrorsShowWhatTheyWouldSeeThroughIt) {
  // A mirror at 45°, 3 km away, that faces a lamp 5 km to its right.
  scene::Scene things;
  const auto turnedPlane = [](float side, const Vec3& axis, float radians, const Vec3& at) {
    scene::Mesh plane = scene::gridPlane(side, side, 1, 1);
    const Mat3 turn = Eigen::AngleAxisf(radians, axis).toRotationMatrix();
    for (Vec3& p : plane.positions) p = turn * p + at;
    for (Vec3& n : plane.normals) n = turn * n;
    return plane;
  };
  const float quarter = float(kPi) / 2;
  scene::Mesh mirror = turnedPlane(4000, Vec3::UnitX(), quarter, Vec3::Zero());
  const Mat3 about = Eigen::AngleAxisf(quarter / 2, Vec3::UnitY()).toRotationMatrix();
  for (Vec3& p : mirror.positions) p = about * p + Vec3(0, 20, -3000);
  for (Vec3& n : mirror.normals) n = about * n;
  scene::addTo(things, mirror, mirrorMaterial(Rgb::Constant(0.5f)));
  scene::Material lamp = diffuseMaterial(Rgb::Zero());
  lamp.emission = Rgb(3, 2, 1);
  scene::addTo(things, turnedPlane(8000, Vec3::UnitZ(), quarter, Vec3(5000, 20, -3000)), lamp);
  const World world(std::move(things));
  PathTraceOptions options;
  options.samples = 4;
  options.air = shade::test::clearAir();
  const Picture seen = seenOver(world, Environment::uniform(Rgb::Zero()), options);
  for (const auto& [x, y] : {std::pair(6, 5), std::pair(5, 4)}) {
    const Vec3 first = lookedAt(x, y), second(-first.z(), first.y(), -first.x());
    const Rgb reflected = options.air->seen(second, 5000, lamp.emission);
    const Rgb expected = options.air->seen(first, 3000, 0.5f * reflected);
    EXPECT_LT((seen.mean.at(x, y) - expected).abs().maxCoeff(), 0.03f * expected.maxCoeff())
        << seen.mean.at(x, y).transpose() << " / " << expected.transpose();
  }
}

}  // namespace
}  // namespace lambent::reference
