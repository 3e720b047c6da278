#include "figures/sun_shadow.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "figures/scenes.h"
#include "figures/sheet.h"
#include "lambent/reference/relit_picture.h"
#include "lambent/render/gl_picture.h"
#include "lambent/scene/shapes.h"
#include "lambent/sh/window.h"
#include "lambent/sources/source.h"

namespace lambent::figures {

namespace {

struct Place {
  std::string name;
  scene::Scene scene;
  scene::Camera camera;
};

Place boxOnFloor() {
  Place place{"box", {}, lookAt(Vec3(-2.4f, 2.3f, 3.2f), Vec3(-0.2f, 0.25f, 0), 36)};
  scene::addTo(place.scene, scene::gridPlane(5, 5, 100, 100),
               diffuseMaterial(Rgb(0.75f, 0.72f, 0.68f)));
  scene::addTo(place.scene,
               scene::translated(scene::box(Vec3(0.7f, 0.9f, 0.7f), 16), Vec3(0, 0.45f, 0)),
               diffuseMaterial(Rgb(0.7f, 0.45f, 0.3f)));
  return place;
}

Place bunnyOnPlane(const Studio& studio) {
  Place place{"bunny", {}, lookAt(Vec3(-3.0f, 2.6f, 4.0f), Vec3(-0.3f, 0.7f, 0), 38)};
  scene::addTo(place.scene, scene::gridPlane(6, 6, 120, 120),
               diffuseMaterial(Rgb(0.75f, 0.72f, 0.68f)));
  const scene::Scene bunny = studio.load("bunny.obj");
  const float lowest = scene::bounds(bunny).lower.y();
  scene::addTo(place.scene, scene::translated(bunny.meshes[0], Vec3(0, -lowest, 0)),
               diffuseMaterial(Rgb(0.8f, 0.8f, 0.8f)));
  return place;
}

light::Environment skyWithSun(double elevation) {
  return orDie(sources::parseSource(fmt::format("sky:sun-elevation={},sun-azimuth=140", elevation)))
      .value;
}

double apart(const image::Image& a, const image::Image& b) {
  double off = 0, power = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    off += double((a.pixels[i] - b.pixels[i]).square().sum());
    power += double(b.pixels[i].square().sum());
  }
  return std::sqrt(off / power);
}

}  // namespace

void sunShadow(const Studio& studio) {
  const int width = studio.pixels(320), height = studio.pixels(240);
  const std::vector<double> elevations = {5, 15, 30, 60};
  fmt::print(
      "| scene | Sun's elevation | 5 bands | 5 bands, minimal window | sharp | sharp, without the "
      "Sun's "
      "bounces | noise of the truth | GL against rays |\n|---|---|---|---|---|---|---|---|\n");
  for (const Place& place : {boxOnFloor(), bunnyOnPlane(studio)}) {
    macro::BakeOptions options;
    options.directions = studio.directions(), options.keepShadowed = true;
    const asset::Asset both = bake(place.scene, options).asset;
    const trace::RayScene rays = orDie(trace::RayScene::build(place.scene));
    Sheet sheet;
    sheet.columnLabels = {"5 bands", "5 bands, minimal window", "sharp Sun (GL)", "path-traced"};
    for (const double elevation : elevations) {
      const light::Environment sky = skyWithSun(elevation);
      const int bands = both.transfer.bands;
      const sh::RgbCoefficients light = sky.project(bands);
      sh::RgbCoefficients minimal = light;
      sh::applyWindow(sh::minimalRinging(light), minimal);
      reference::PathTraceOptions traced;
      traced.samples = studio.paths(128), traced.bounces = both.transfer.bounces;
      const reference::Picture truth =
          orDie(reference::picture(place.scene, rays, sky, place.camera, width, height, traced));
      shade::PictureOptions shown;
      shown.width = width, shown.height = height, shown.samples = 16;
      const auto picture = [&](const sh::RgbCoefficients& relit) {
        return orDie(reference::relitPicture(both, relit, sky, place.camera, shown));
      };
      const image::Image soft = picture(light), windowed = picture(minimal);
      shown.sun = shade::sharpSunOf(sky, std::vector<double>(std::size_t(bands), 1.0));
      const image::Image sharp = picture(light);
      // As if nothing but the sky bounced: the Sun's share of all transfer is taken out.
      sh::RgbCoefficients rest = light;
      for (std::size_t i = 0; i < rest.values.size(); ++i)
        rest.values[i] -= shown.sun->share.values[i];
      shade::PictureOptions direct = shown;
      direct.sun->share = sh::RgbCoefficients(bands);
      const image::Image unbounced =
          orDie(reference::relitPicture(both, rest, sky, place.camera, direct));
      const image::Image gl = orDie(render::picture(both, light, sky, place.camera, shown));
      double noise = 0, power = 0;
      for (std::size_t i = 0; i < truth.mean.pixels.size(); ++i) {
        noise += double(truth.variance.pixels[i].sum());
        power += double(truth.mean.pixels[i].square().sum());
      }
      fmt::print("| {} | {}° | {:.1f}% | {:.1f}% | {:.2f}% | {:.2f}% | {:.2f}% | {:.2f}% |\n",
                 place.name, elevation, 100 * errorBeyondNoise(soft, truth),
                 100 * errorBeyondNoise(windowed, truth), 100 * errorBeyondNoise(sharp, truth),
                 100 * errorBeyondNoise(unbounced, truth), 100 * std::sqrt(noise / power),
                 100 * apart(gl, sharp));
      std::fflush(stdout);
      const float ev = exposureOf(truth.mean);
      sheet.rowLabels.push_back(fmt::format("{} deg", elevation));
      sheet.rows.push_back(
          {develop(soft, ev), develop(windowed, ev), develop(gl, ev), develop(truth.mean, ev)});
    }
    studio.save(compose(sheet), "sun-shadow-" + place.name);
  }
}

}  // namespace lambent::figures
