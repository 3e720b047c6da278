#include "figures/relief.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "lambent/math/directions.h"
#include "lambent/meso/effective_albedo.h"
#include "lambent/meso/generators.h"
#include "lambent/render/gl_picture.h"
#include "lambent/sh/window.h"
#include "lambent/transfer/encode.h"

namespace lambent::figures {

BuiltRtt build(const meso::Patch& patch, const meso::RttOptions& options) {
  BuiltRtt built;
  const auto start = std::chrono::steady_clock::now();
  built.rtt = orDie(meso::buildRtt(patch, options, {}, &built.cost)).value;
  built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return built;
}

meso::RttOptions rttOptions(const Studio& studio) {
  meso::RttOptions options;
  options.directions = 128;  // of each of 2x2 sub-samples
  if (studio.quick) options.width = options.height = 32, options.directions = 32;
  return options;
}

transfer::SimulatedRtt rttNamed(const Studio& studio, const std::string& name) {
  const auto kept = studio.rtts->find(name);
  if (kept != studio.rtts->end()) return kept->second;
  meso::RttOptions options = rttOptions(studio);
  if (name == "plaster" || name == "stucco" || name == "flower") {
    options.views = 1;
    if (!studio.quick) options.width = options.height = 128, options.directions = 512;
  }
  const BuiltRtt built = build(*meso::generate(name, Vec2(0.1f, 0.1f)), options);
  fmt::print("{}: {}x{}, {}x{} views, {:.1f} million rays, {:.1f} s\n", name, built.rtt.width,
             built.rtt.height, built.rtt.views, built.rtt.views,
             double(built.cost.viewRays + built.cost.lightRays) * 1e-6, built.seconds);
  std::fflush(stdout);
  return studio.rtts->emplace(name, built.rtt).first->second;
}

bi_scale::Spread spread(const scene::Scene& scene, const transfer::SimulatedRtt& rtt,
                        bi_scale::SpreadOptions options) {
  options.albedo = meso::effectiveAlbedo(rtt);
  options.transfer.bands = rtt.bands;
  return orDie(bi_scale::spreadPatch(scene, transfer::encode(rtt, transfer::Encoding::Float32),
                                     options))
      .value;
}

image::Image photograph(const asset::Asset& asset, const sh::RgbCoefficients& light,
                        const shade::Showing& showing, const Shot& shot) {
  shade::PictureOptions picture;
  picture.width = shot.width, picture.height = shot.height, picture.samples = shot.samples;
  picture.showing = showing;
  return orDie(
      render::picture(asset, light, light::Environment::harmonics(light), shot.camera, picture));
}

sh::RgbCoefficients fiveBands(const light::Environment& environment) {
  sh::RgbCoefficients light = environment.project(5);
  sh::applyWindow(sh::minimalRinging(light), light);
  return light;
}

sh::RgbCoefficients smallestLight(const Vec3& direction, const Rgb& irradiance) {
  return light::Environment::directional(direction, irradiance).project(5);
}

light::Environment discLight(const Vec3& direction, double diameterDegrees, const Rgb& irradiance) {
  const double sine = std::sin(0.5 * diameterDegrees * kPi / 180.0);
  return light::Environment::disc(direction, diameterDegrees * kPi / 180.0,
                                  irradiance / float(kPi * sine * sine));
}

Vec3 towards(float azimuth, float elevation) {
  return math::directionFromAzimuthElevation(azimuth * kPi / 180, elevation * kPi / 180)
      .cast<float>();
}

}  // namespace lambent::figures
