// shaders/environment.glsl against light::Environment::radiance.

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "lambent/light/environment.h"
#include "lambent/light/skylight.h"
#include "lambent/light/test_skylight.h"
#include "lambent/math/directions.h"
#include "tests/shaders/test_glsl.h"

#include "tests/shaders/glsl_begin.h"

namespace lambent::glsl::seen {
#include "shaders/environment.glsl"

sampler2D map = nullptr;
mat3 mapFromEnvironment;

vec3 latLongTexel(sampler2D picture, ivec2 texel) {
  const float* rgb = picture->rgb + 3 * (texel.y * picture->size.x + texel.x);
  return {rgb[0], rgb[1], rgb[2]};
}
sampler2D sky = nullptr;

vec3 radianceOfMaps(vec3 d) {
  vec3 sum = map ? sampleLatLong(map, mapFromEnvironment * d) : vec3(0.0f);
  if (sky) sum += sampleSkylight(sky, d);
  return sum;
}
}  // namespace lambent::glsl::seen

#include "tests/shaders/glsl_end.h"

namespace lambent::glsl {
namespace {

using light::Environment;

/// As render::GlEnvironment and the page set it up.
void show(const Environment::Parts& parts, const Mat3& environmentFromWorld) {
  ASSERT_LE(parts.discs.size(), std::size_t(seen::kMostDiscs));
  ASSERT_LE(parts.images.size(), 1u);
  seen::environmentFromWorld = from(environmentFromWorld);
  seen::everywhere = from(parts.uniform);
  seen::discCount = int(parts.discs.size());
  for (std::size_t k = 0; k < parts.discs.size(); ++k) {
    const auto& disc = parts.discs[k];
    seen::discs[k] = vec4(from(disc.axis), float(disc.versine));
    seen::discRadiances[k] = from(disc.radiance);
    seen::discDarkenings[k] = from(disc.darkening);
    seen::discHorizons[k] = vec4(from(disc.up), float(disc.horizon));
  }
  static Picture skyPicture;
  static std::vector<Rgb> skyTexels;
  seen::sky = nullptr;
  if (parts.sky) {
    constexpr int kWidth = 512, kHeight = 256;
    skyTexels.clear();
    const double horizon = parts.sky->light->horizon();
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double v = 1 - y / (kHeight - 1.0);
        skyTexels.push_back(parts.sky->light->radiance(math::directionFromAzimuthElevation(
            2 * kPi * ((x + 0.5) / kWidth - 0.5), horizon + (kPi / 2 - horizon) * v * v)));
      }
    skyPicture = {ivec2(kWidth, kHeight), skyTexels[0].data()};
    seen::sky = &skyPicture;
    const Vec3 up = parts.sky->worldFromSky.col(1);
    seen::skylightFromEnvironment = from(Mat3(parts.sky->worldFromSky.transpose()));
    seen::skylightHorizon = vec4(from(up), float(parts.sky->horizon));
  }
  static Picture picture;
  seen::map = nullptr;
  if (parts.images.empty()) return;
  const image::Image& image = *parts.images[0].image;
  picture = {ivec2(image.width, image.height), image.pixels[0].data()};
  seen::map = &picture;
  seen::mapFromEnvironment = from(Mat3(parts.images[0].worldFromImage.transpose()));
}

/// Whether a rounded direction could lie on either side of a disc's border.
bool isOnABorder(const Environment::Parts& parts, const Vec3& d) {
  if (parts.sky &&
      std::abs(double(d.dot(parts.sky->worldFromSky.col(1))) - parts.sky->horizon) < 1e-6)
    return true;
  for (const auto& disc : parts.discs) {
    const double off = (d - disc.axis).cast<double>().squaredNorm();
    if (std::abs(off - 2 * disc.versine) < 1e-6 * std::sqrt(disc.versine)) return true;
    if (std::abs(double(d.dot(disc.up)) - disc.horizon) < 1e-6) return true;
  }
  return false;
}

void expectSame(const Environment& environment, std::uint64_t seed, float tolerance,
                const Vec3& near = Vec3::Zero(), float spread = 0.0f) {
  const Environment::Parts parts = environment.parts();
  const Mat3 worldFromEnvironment = math::randomRotation(seed);
  show(parts, worldFromEnvironment.transpose());
  math::Random random(seed, 1);
  int skipped = 0, different = 0;
  constexpr int kMany = 20'000;
  for (int i = 0; i < kMany; ++i) {
    Vec3 d = anyDirection(random);
    if (spread > 0) d = (near + spread * d).normalized();
    const Rgb expected = environment.radiance(d);
    if (isOnABorder(parts, d)) {
      ++skipped;
      continue;
    }
    different += (expected != parts.uniform).any();
    const Vec3 world = between(random, 0.5f, 2.0f) * (worldFromEnvironment * d);  // of any length
    ASSERT_LT(apart(seen::environmentRadiance(from(world)), expected), tolerance) << d.transpose();
  }
  EXPECT_LT(skipped, kMany / 50);
  EXPECT_GT(different, kMany / 50);
}

image::Image noise(int width, int height, std::uint64_t seed) {
  math::Random random(seed, 2);
  image::Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = anyColor(random);
  return image;
}

TEST(EnvironmentText, MapsAreTheLibrarys) {
  // An azimuth has 2e-7 of it, and less near the poles: so much of a pixel, from one to the next.
  for (const auto& [width, height] : {std::pair{64, 32}, {7, 5}, {1, 1}})
    expectSame(Environment::latLong(noise(width, height, 1)).rotated(math::randomRotation(5)) +
                   Environment::uniform(Rgb(0.1f, 0.2f, 0.3f)),
               std::uint64_t(width), 1e-4f);
}

// Side by side, one within another, half of the sphere, and all of it: 16 altogether.
TEST(EnvironmentText, DiscsAreTheLibrarys) {
  Environment sum = Environment::uniform(Rgb(0.1f, 0.2f, 0.3f));
  const Vec3 sun = Vec3(1, 2, -0.5f).normalized();
  sum = sum + Environment::disc(sun, 0.0093, Rgb(7, 6, 5));
  sum = sum + Environment::disc(Vec3(-0.3f, -1, 0.2f).normalized(), kPi, Rgb(1, 0.5f, 0.2f));
  sum = sum + Environment::disc(Vec3::UnitX(), 2 * kPi, Rgb(0.3f, 0.3f, 0.7f));
  for (int k = 3; k < seen::kMostDiscs; ++k)
    sum = sum + Environment::disc((sun + 0.004f * float(k) * Vec3(1, -0.5f, 0.3f)).normalized(),
                                  0.005 * k, Rgb(0.1f * float(k), 1, 2));
  EXPECT_EQ(sum.parts().discs.size(), std::size_t(seen::kMostDiscs));
  EXPECT_DOUBLE_EQ(sum.parts().discs[1].versine, 1.0);
  EXPECT_DOUBLE_EQ(sum.parts().discs[2].versine, 2.0);
  expectSame(sum, 3, 2e-6f);
  expectSame(sum, 4, 2e-6f, sun, 0.1f);
  expectSame(sum, 5, 2e-6f, sun, 0.008f);
}

// One that stands free, and one that is half set.
TEST(EnvironmentText, DarkenedDiscsAreTheLibrarys) {
  for (const double elevation : {0.4, 0.01}) {
    const Vec3 sun = math::directionFromAzimuthElevation(1, elevation).cast<float>();
    const Environment light = Environment::disc({.direction = sun,
                                                 .angularDiameter = 0.1,
                                                 .irradiance = Rgb(0.003f, 0.002f, 0.001f),
                                                 .darkening = Rgb(0.5f, 0.6f, 0.7f),
                                                 .horizon = 0});
    // At the rim the root of what is left of the radius grows without bound.
    expectSame(light, 6, 2e-3f, sun, 0.08f);
    expectSame(light, 7, 1e-5f, sun, 0.02f);
  }
}

TEST(EnvironmentText, SkyAndGroundAreTheLibrarys) {
  for (const double horizon : {-0.1, 0.0, 0.2})
    for (const Mat3& turn : {Mat3(Mat3::Identity()), math::randomRotation(8)}) {
      const Environment light =
          Environment::skylight(std::make_shared<light::test::Glow>(horizon, Rgb(1, 2, 3)), turn) +
          Environment::ground(turn.col(1), horizon, Rgb(0.3f, 0.2f, 0.1f));
      expectSame(light, 8, 1e-3f);
      const Vec3 level = math::directionFromAzimuthElevation(0.3, horizon).cast<float>();
      expectSame(light, 9, 1e-3f, turn * level, 1e-3f);
    }
}

TEST(EnvironmentText, AFullDiscIsEverywhere) {
  show(Environment::disc(Vec3::UnitY(), 2 * kPi, Rgb(1, 2, 3)).parts(), Mat3::Identity());
  for (const Vec3& d : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)})
    EXPECT_LT(apart(seen::environmentRadiance(from(d)), Rgb(1, 2, 3)), 1e-9f);
}

}  // namespace
}  // namespace lambent::glsl
