#include "lambent/shade/sharp_sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lambent/macro/bake.h"
#include "lambent/reference/path_tracer.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/scene/shapes.h"
#include "lambent/shade/lit_mesh.h"
#include "lambent/shade/test_assets.h"
#include "lambent/transfer/encode.h"

namespace lambent::shade {
namespace {

using transfer::Kind;

asset::Asset baked(const scene::Scene& scene, Kind kind, bool keepShadowed) {
  const auto rays = trace::RayScene::build(scene);
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  macro::BakeOptions options;
  options.kind = kind, options.keepShadowed = keepShadowed;
  options.directions = 1024;
  const auto field = macro::bake(scene, *rays, *receivers, options, {});
  return {scene, transfer::encode(field->value, transfer::Encoding::Float32)};
}

/// A white box on a floor.
scene::Scene boxOnFloor() {
  scene::Scene scene;
  scene::Material white;
  white.diffuse = Rgb(0.8f, 0.7f, 0.6f);
  scene::addTo(scene, scene::gridPlane(4, 4, 32, 32), white);
  scene::addTo(scene, scene::translated(scene::box(Vec3(0.6f, 0.6f, 0.6f), 4), Vec3(0, 0.3f, 0)),
               white);
  return scene;
}

light::Environment sky(double elevation) {
  const double e = elevation * kPi / 180;
  return light::Environment::uniform(Rgb(0.3f, 0.4f, 0.6f)) +
         light::Environment::disc({.direction = Vec3(float(std::cos(e)), float(std::sin(e)), 0),
                                   .angularDiameter = 0.0093,
                                   .irradiance = Rgb(5.0f, 4.5f, 4.0f)});
}

std::vector<double> noWindow(int bands) {
  return std::vector<double>(std::size_t(bands), 1.0);
}

image::Image picture(const asset::Asset& asset, const light::Environment& light,
                     std::optional<Kind> kind, SunShadow shadow) {
  PictureOptions options;
  options.width = 96, options.height = 64, options.samples = 16;
  options.showing = Showing::of(kind);
  if (shadow == SunShadow::Sharp) options.sun = sharpSunOf(light, noWindow(5));
  auto image =
      reference::relitPicture(asset, light.project(5), light,
                              test::cameraAt(Vec3(1.5f, 1.5f, 2.5f), Vec3(0, 0.2f, 0)), options);
  return std::move(*image);
}

image::Image truth(const scene::Scene& scene, const light::Environment& light, int bounces) {
  const auto rays = trace::RayScene::build(scene);
  reference::PathTraceOptions options;
  options.samples = 256, options.bounces = bounces;
  const auto traced =
      reference::picture(scene, *rays, light,
                         test::cameraAt(Vec3(1.5f, 1.5f, 2.5f), Vec3(0, 0.2f, 0)), 96, 64, options);
  return traced->mean;
}

double relativeRmse(const image::Image& ours, const image::Image& truth) {
  double off = 0, power = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    off += double((ours.pixels[i] - truth.pixels[i]).square().sum());
    power += double(truth.pixels[i].square().sum());
  }
  return std::sqrt(off / power);
}

// Where nothing hides the Sun and nothing bounces: ρ/π (E_sky + E_sun n·s), to the last digits, where
// five bands would be some percents off.
TEST(SharpSun, OnAPlaneIsTheCosine) {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(4, 4, 2, 2), {});
  const asset::Asset asset = baked(scene, Kind::Shadowed, false);
  for (const double elevation : {5.0, 30.0, 90.0}) {
    const auto image = picture(asset, sky(elevation), {}, SunShadow::Sharp);
    const Rgb expected =
        0.8f * (Rgb(0.3f, 0.4f, 0.6f) +
                Rgb(5.0f, 4.5f, 4.0f) * float(std::sin(elevation * kPi / 180) / kPi));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(48, 40)[c], expected[c], 0.004f * expected[c]);
  }
}

TEST(SharpSun, CountsNothingTwice) {
  const scene::Scene scene = boxOnFloor();
  const asset::Asset both = baked(scene, Kind::Interreflected, true);
  ASSERT_TRUE(offers(both, Kind::Shadowed));
  for (const double elevation : {15.0, 45.0}) {
    const light::Environment light = sky(elevation);
    const image::Image expected = truth(scene, light, both.transfer.bounces);
    const double sharp = relativeRmse(picture(both, light, {}, SunShadow::Sharp), expected);
    const double soft = relativeRmse(picture(both, light, {}, SunShadow::Soft), expected);
    EXPECT_LT(sharp, 0.06) << elevation;
    EXPECT_GT(soft, 2 * sharp) << elevation;
    const double shadowed = relativeRmse(picture(both, light, Kind::Shadowed, SunShadow::Sharp),
                                         truth(scene, light, 0));
    EXPECT_LT(shadowed, 0.06) << elevation;
  }
}

TEST(SharpSun, UnshadowedIsNeverHidden) {
  const asset::Asset asset = baked(boxOnFloor(), Kind::Shadowed, false);
  const light::Environment light = sky(30);
  const image::Image image = picture(asset, light, Kind::Unshadowed, SunShadow::Sharp);
  // Beside the box, in what would be its shadow.
  const Rgb expected =
      Rgb(0.8f, 0.7f, 0.6f) * (Rgb(0.3f, 0.4f, 0.6f) + Rgb(5.0f, 4.5f, 4.0f) * float(0.5 / kPi));
  int asExpected = 0;
  for (const Rgb& pixel : image.pixels)
    asExpected += (pixel / expected - 1).abs().maxCoeff() < 0.01f;
  EXPECT_GT(asExpected, 96 * 64 / 2);
}

TEST(SharpSun, IsWindowedAsItsLightIs) {
  const light::Environment light = sky(30);
  const auto sun = sharpSunOf(light, {1, 0.5, 0.25});
  ASSERT_TRUE(sun);
  const sh::RgbCoefficients whole = light::project(sun->sun, 3);
  EXPECT_EQ(sun->share.channel(0)[0], whole.channel(0)[0]);
  EXPECT_EQ(sun->share.channel(1)[2], 0.5f * whole.channel(1)[2]);
  EXPECT_EQ(sun->share.channel(2)[7], 0.25f * whole.channel(2)[7]);
}

TEST(SharpSun, SaysWhatItCannotShow) {
  const scene::Scene scene = boxOnFloor();
  EXPECT_TRUE(sharpSunFindings(baked(scene, Kind::Interreflected, true), {}).empty());
  EXPECT_TRUE(sharpSunFindings(baked(scene, Kind::Shadowed, false), {}).empty());
  const Findings found = sharpSunFindings(baked(scene, Kind::Interreflected, false), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "sun-with-bounces");
  EXPECT_EQ(found[0].count, 2u);
}

}  // namespace
}  // namespace lambent::shade
