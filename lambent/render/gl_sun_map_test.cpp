// Sharp shadows of the Sun by OpenGL against rays.

#include "lambent/render/gl_sun_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_picture.h"
#include "lambent/render/live_renderer.h"
#include "lambent/render/test_agreement.h"
#include "lambent/shade/test_assets.h"

namespace lambent::render {
namespace {

using shade::PictureOptions;
using test::kCamera;
using transfer::Kind;

light::Environment sunAt(float elevation) {
  return light::Environment::uniform(Rgb(0.2f, 0.3f, 0.5f)) +
         light::Environment::disc(
             {.direction =
                  Vec3(0.6f * std::cos(elevation), std::sin(elevation), 0.8f * std::cos(elevation)),
              .angularDiameter = 0.0093,
              .irradiance = Rgb(4.0f, 3.6f, 3.0f)});
}

PictureOptions sharp(const light::Environment& light, int bands, int samples) {
  PictureOptions options = test::small(samples);
  options.sun = shade::sharpSunOf(light, std::vector<double>(std::size_t(bands), 1.0));
  return options;
}

/// A ball over a floor, with closed-form transfer: no matter that it is not shadowed, for what is
/// compared is who sees the Sun.
asset::Asset ballOverFloor(bool texels) {
  asset::Asset asset;
  scene::Mesh ball = shade::test::sphere(Vec3(0, 0.1f, 0), 0.7f, 32);
  for (const Vec3& p : ball.positions) ball.colors.emplace_back(1.0f, 0.7f + 0.2f * p.y(), 0.9f);
  shade::test::addDiffuse(asset, ball, {5, 3, transfer::Encoding::Float16, true});
  if (texels)
    shade::test::addTexels(asset, shade::test::floor(Vec3(0, -0.7f, 0), 1.8f), Vec3::UnitY(), 16,
                           11, 0, transfer::Encoding::Float32);
  else
    shade::test::addDiffuse(asset, shade::test::floor(Vec3(0, -0.7f, 0), 1.8f), {});
  for (auto& mesh : asset.transfer.meshes) {
    // As if it had been baked with shadows.
    auto& surface = std::get<transfer::Surface<transfer::Numbers>>(mesh);
    auto held = *surface.responses.find(*surface.responses.most());
    surface.responses.drop(*surface.responses.most());
    surface.responses.set(Kind::Shadowed, std::move(held));
  }
  asset.transfer.kind = Kind::Shadowed;
  return asset;
}

TEST(GlSunMap, SeesTheSunWhereRaysDo) {
  for (const bool texels : {false, true})
    for (const float elevation : {0.1f, 0.5f, 1.3f}) {
      const asset::Asset asset = ballOverFloor(texels);
      const light::Environment light = sunAt(elevation);
      const PictureOptions options = sharp(light, 5, 16);
      ASSERT_TRUE(options.sun);
      const auto cpu = reference::relitPicture(asset, light.project(5), light, kCamera, options);
      const auto gl = picture(asset, light.project(5), light, kCamera, options);
      ASSERT_TRUE(cpu && gl) << gl.error().message;
      // Borders of shadows differ by parts of a texel.
      test::expectSame("sun-" + std::to_string(texels) + "-" + std::to_string(elevation), *cpu, *gl,
                       {.mean = 0.25, .interior = 8});
      PictureOptions soft = options;
      soft.sun.reset();
      const auto without = reference::relitPicture(asset, light.project(5), light, kCamera, soft);
      double change = 0;
      for (std::size_t i = 0; i < cpu->pixels.size(); ++i)
        change += double((cpu->pixels[i] - without->pixels[i]).abs().sum());
      EXPECT_GT(change / double(cpu->pixels.size()), 0.02);
    }
}

TEST(GlSunMap, LiveFramesAddUpToThePicture) {
  const asset::Asset asset = ballOverFloor(false);
  const light::Environment light = sunAt(0.5f);
  const PictureOptions options = sharp(light, 5, 8);
  const auto cpu = reference::relitPicture(asset, light.project(5), light, kCamera, options);
  const auto context = GlContext::create();
  ASSERT_TRUE(context) << context.error().message;
  auto live = LiveRenderer::make(asset, {});
  ASSERT_TRUE(live) << live.error().message;
  ASSERT_TRUE(live->resize(options.width, options.height));
  live->setLight(light.project(5));
  LiveView view;
  view.camera = kCamera;
  view.background = false;
  const auto shown = [&] {
    live->begin();
    for (const Vec2& place : scene::subpixelPositions(8)) EXPECT_TRUE(live->add(view, place, 8));
    return *live->picture();
  };
  const image::Image soft = shown();
  ASSERT_TRUE(live->setSun(options.sun));
  test::expectSame("sun-live", *cpu, shown(), {.mean = 0.25, .interior = 8});
  ASSERT_TRUE(live->setSun({}));
  const image::Image again = shown();
  for (std::size_t i = 0; i < soft.pixels.size(); ++i)
    EXPECT_TRUE((soft.pixels[i] == again.pixels[i]).all());
}

}  // namespace
}  // namespace lambent::render
