// Light that textured surfaces send on has the colour of the place that it left.
#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/test_bake.h"
#include "lambent/sh/coefficients.h"

namespace lambent::macro {
namespace {

/// From a point to a parallel rectangle that has a corner straight before it, a·b at distance c:
/// the share of what falls on the point (howell's catalogue, B-3).
double cornerFactor(double a, double b, double c) {
  const double p = std::sqrt(a * a + c * c), q = std::sqrt(b * b + c * c);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * kPi);
}

/// The same of the rectangle from x0 to x1, z0 to z1.
double factor(double x0, double x1, double z0, double z1, double c) {
  const auto corner = [&](double x, double z) {
    const double sign = (x < 0.0) == (z < 0.0) ? 1.0 : -1.0;
    return sign * cornerFactor(std::abs(x), std::abs(z), c);
  };
  return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

/// Red to the left, blue to the right.
scene::Texture halves() {
  scene::Texture texture;
  texture.width = 256, texture.height = 1;
  texture.wrapU = texture.wrapV = scene::Wrap::ClampToEdge;
  for (int x = 0; x < 256; ++x) {
    const bool left = x < 128;
    for (const int code : {left ? 255 : 0, 0, left ? 0 : 255, 255})
      texture.rgba.push_back(static_cast<std::uint8_t>(code));
  }
  return texture;
}

scene::Scene probesOverFloor(const scene::Material& floor) {
  scene::Scene scene;
  scene.textures.push_back(halves());
  scene::addTo(scene, scene::gridPlane(2, 2, 1, 1), floor);
  scene.materials[0].baseColorTexture = 0;
  for (const float x : {-0.5f, 0.0f, 0.7f})
    scene::addTo(scene,
                 scene::translated(scene::flipped(scene::gridPlane(0.01f, 0.01f, 1, 1)),
                                   Vec3(x, 0.4f, 0.1f)),
                 painted(Rgb::Constant(0.5f)));
  return scene;
}

double uniformOf(const BakedMesh& mesh, std::size_t receiver, int channel) {
  return mesh.vectors[(receiver * mesh.channels + channel) * sh::coefficientCount(mesh.bands)] *
         std::sqrt(4.0 * kPi);
}

TEST(TexturedBounce, AFloorOfOneQuadSendsTheColourOfEachPlace) {
  const scene::Scene scene = probesOverFloor(painted(Rgb(0.8f, 0.8f, 0.6f)));
  BakeOptions options;
  options.bands = 3;
  options.bounces = 1;
  const transfer::SimulatedField field = bakeOrDie(scene, options);
  for (const std::uint32_t probe : {1u, 2u, 3u}) {
    const BakedMesh mesh = meshOf(field, probe);
    ASSERT_EQ(mesh.channels, 3);
    for (std::size_t r = 0; r < mesh.receiverCount(); ++r) {
      const double x = mesh.positions[r].x(), z = mesh.positions[r].z();
      const double left = factor(-1 - x, -x, -1 - z, 1 - z, 0.4);
      const double right = factor(-x, 1 - x, -1 - z, 1 - z, 0.4);
      const double sky = 1.0 - left - right;
      EXPECT_NEAR(uniformOf(mesh, r, 0), 0.5 * (sky + 0.8 * left), 2e-3);
      EXPECT_NEAR(uniformOf(mesh, r, 1), 0.5 * sky, 2e-3);
      EXPECT_NEAR(uniformOf(mesh, r, 2), 0.5 * (sky + 0.6 * right), 2e-3);
    }
  }
}

TEST(TexturedBounce, MatricesAndMirrorsTakeTheColourToo) {
  // The probes are glossy, and one of them is a mirror that shows the floor to a probe below it.
  scene::Scene scene = probesOverFloor(painted(Rgb::Constant(0.8f)));
  scene.materials[1].glossy = Rgb::Constant(0.5f);
  scene::Material mirror;
  mirror.mirror = Rgb::Ones();
  scene::addTo(scene,
               scene::translated(scene::flipped(scene::gridPlane(2, 2, 1, 1)), Vec3(0, 0.8f, 0)),
               mirror);
  scene::addTo(scene,
               scene::translated(scene::gridPlane(0.01f, 0.01f, 1, 1), Vec3(-0.5f, 0.4f, 0.1f)),
               painted(Rgb::Constant(0.5f)));
  BakeOptions options;
  options.bands = 3;
  options.bounces = 1;
  const transfer::SimulatedField field = bakeOrDie(scene, options);
  const BakedMesh upward = meshOf(field, 5), glossy = meshOf(field, 1);
  // By way of the mirror the floor lies 0.4 + 0.8 m before the probe that looks up; what is green
  // comes past both, from the sky.
  for (std::size_t r = 0; r < upward.receiverCount(); ++r) {
    EXPECT_GT(uniformOf(upward, r, 0), uniformOf(upward, r, 1) + 0.02);
    EXPECT_GT(uniformOf(upward, r, 0), uniformOf(upward, r, 2) + 0.02);
  }
  // ∫ over directions of the light that arrives, channel by channel: the first entry of the matrix.
  ASSERT_EQ(glossy.matrixChannels, 3);
  const std::size_t perChannel = 81;
  for (std::size_t r = 0; r < glossy.receiverCount(); ++r) {
    const float* m = glossy.matrices.data() + r * 3 * perChannel;
    EXPECT_GT(m[0], m[perChannel] + 0.02f);
    EXPECT_GT(m[0], m[2 * perChannel] + 0.02f);
  }
}

TEST(TexturedBounce, KeptHitsAndHitsCastAgainAreTheSame) {
  const scene::Scene scene = probesOverFloor(painted(Rgb::Constant(0.8f)));
  BakeOptions options = small();
  const transfer::SimulatedField kept = bakeOrDie(scene, options);
  options.hitMemory = 0;
  options.threads = 2;
  const transfer::SimulatedField again = bakeOrDie(scene, options);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    EXPECT_EQ(meshOf(kept, m).vectors, meshOf(again, m).vectors);
}

}  // namespace
}  // namespace lambent::macro
