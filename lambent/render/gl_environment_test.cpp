// What mirrors and the background show by OpenGL against the CPU.

#include "lambent/render/gl_environment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lambent/light/test_skylight.h"
#include "lambent/math/random.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_picture.h"
#include "lambent/render/shader_sources.h"
#include "lambent/render/test_agreement.h"
#include "lambent/shade/test_assets.h"

namespace lambent::render {
namespace {

using light::Environment;

/// As many as are shown as they are: half of the sphere, all of it, a sun, and neighbours that
/// touch and cover each other.
Environment discs() {
  const Vec3 sun = Vec3(0.4f, 0.7f, 0.6f).normalized();
  Environment sum =
      Environment::disc(Vec3(-0.3f, 1, 0.2f).normalized(), kPi, Rgb(0.2f, 0.1f, 0.4f));
  sum = sum + Environment::disc(Vec3::UnitX(), 2 * kPi, Rgb(0.1f, 0.2f, 0.1f));
  sum = sum + Environment::disc(sun, 0.0093, Rgb(90, 80, 70));
  for (int k = 3; k < int(kMostDiscs); ++k) {
    const Vec3 beside(std::cos(0.9f * float(k)), 0.3f, std::sin(0.9f * float(k)));
    sum = sum + Environment::disc((sun + 0.05f * float(k) * beside).normalized(), 0.02 * k,
                                  Rgb(0.1f * float(k), 0.4f, 1.6f - 0.1f * float(k)));
  }
  return sum;
}

TEST(GlEnvironment, ShowsAsManyDiscsAsItsShader) {
  const std::string declared = "const int kMostDiscs = " + std::to_string(kMostDiscs) + ";";
  EXPECT_NE(shaderSource("environment.glsl").find(declared), std::string_view::npos);
  EXPECT_EQ(discs().parts().discs.size(), kMostDiscs);
}

TEST(GlEnvironment, ShowsDiscsAsTheCpuDoes) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3::Zero(), 1.4f, 32), Rgb(0.9f, 0.8f, 0.7f));
  const scene::Camera camera = shade::test::cameraAt(Vec3(1.5f, 1.8f, 5.0f), Vec3::Zero());
  shade::PictureOptions options;
  options.width = 128;
  options.height = 96;
  options.samples = 4;
  const sh::RgbCoefficients light(3);
  for (const Environment& environment : {discs(), discs() + shade::test::sky()})
    for (const bool background : {false, true}) {
      options.background = background;
      const auto cpu = reference::relitPicture(asset, light, environment, camera, options);
      ASSERT_TRUE(cpu) << cpu.error().message;
      const auto gl = render::picture(asset, light, environment, camera, options);
      ASSERT_TRUE(gl) << gl.error().message;
      test::expectSame(background ? "discs-behind" : "discs", *cpu, *gl);
    }
}

TEST(GlEnvironment, ShowsASkyAboveItsGroundAsTheCpuDoes) {
  asset::Asset asset;
  shade::test::addMirror(asset, shade::test::sphere(Vec3::Zero(), 0.7f, 32), Rgb::Ones());
  const scene::Camera camera = shade::test::cameraAt(Vec3(-3.0f, 0.2f, 0.1f), Vec3(0, 0.3f, 0));
  shade::PictureOptions options;
  options.width = 128;
  options.height = 96;
  options.samples = 4;
  options.background = true;
  const Environment light =
      Environment::skylight(std::make_shared<light::test::Glow>(-0.05, Rgb(1, 2, 3)),
                            Mat3::Identity()) +
      Environment::disc({.direction = Vec3(1, 0, 0.3f).normalized(),
                         .angularDiameter = 0.2,
                         .irradiance = Rgb(0.2f, 0.1f, 0.05f),
                         .darkening = Rgb(0.5f, 0.6f, 0.7f),
                         .horizon = -0.05}) +
      Environment::ground(Vec3::UnitY(), -0.05, Rgb(0.3f, 0.2f, 0.1f));
  const sh::RgbCoefficients none(3);
  for (const Environment& each : {light, light.rotated(math::randomRotation(3))}) {
    const auto cpu = reference::relitPicture(asset, none, each, camera, options);
    ASSERT_TRUE(cpu) << cpu.error().message;
    const auto gl = render::picture(asset, none, each, camera, options);
    ASSERT_TRUE(gl) << gl.error().message;
    test::expectSame("sky", *cpu, *gl);
  }
}

}  // namespace
}  // namespace lambent::render
