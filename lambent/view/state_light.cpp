#include "lambent/view/state_light.h"

#include "lambent/light/windowing.h"
#include "lambent/sh/rotation.h"
#include "lambent/sh/window.h"
#include "lambent/view/placement.h"

namespace lambent::view {

StateLight::StateLight(const light::Environment& environment, int bands)
    : environment_(environment.project(bands)), sun_(light::sunOf(environment)) {}

const sh::RgbCoefficients& StateLight::world(const ViewState& state) {
  if (world_ && rotation_ == state.environmentRotation && discs_ == state.discs &&
      window_ == state.window)
    return *world_;
  sh::RgbCoefficients light =
      sh::rotate(matrixOf(state.environmentRotation).cast<float>(), environment_);
  for (const Disc& disc : state.discs) {
    const sh::RgbCoefficients added = environmentOf(disc).project(bands());
    for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] += added.values[i];
  }
  // A state's window has been checked where it was read; one that is not understood softens
  // nothing.
  const auto windowing = light::parseWindowing(state.window);
  factors_ = light::windowOf(windowing ? *windowing : light::Windowing(), light);
  sh::applyWindow(factors_, light);
  rotation_ = state.environmentRotation, discs_ = state.discs, window_ = state.window;
  return world_.emplace(std::move(light));
}

sh::RgbCoefficients StateLight::asset(const ViewState& state) {
  const Mat3 assetFromWorld = matrixOf(state.objectRotation).transpose().cast<float>();
  return sh::rotate(assetFromWorld, world(state));
}

std::optional<shade::SharpSun> StateLight::sharpSun(const ViewState& state) {
  if (state.sunShadow != shade::SunShadow::Sharp) return std::nullopt;
  light::Environment small;
  if (sun_)
    small = light::Environment::disc(
        light::turned(matrixOf(state.environmentRotation).cast<float>(), *sun_).disc);
  for (const Disc& disc : state.discs)
    if (disc.diameter * kRadiansPerDegree <= light::kLargestSun)
      small = small + environmentOf(disc);
  world(state);
  const Mat3 assetFromWorld = matrixOf(state.objectRotation).transpose().cast<float>();
  return shade::sharpSunOf(small.rotated(assetFromWorld), factors_);
}

}  // namespace lambent::view
