#include "lambent/view/state_light.h"

#include "lambent/light/windowing.h"
#include "lambent/sh/rotation.h"
#include "lambent/view/placement.h"

namespace lambent::view {

StateLight::StateLight(const light::Environment& environment, int bands)
    : environment_(environment.project(bands)) {}

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
  if (const auto windowing = light::parseWindowing(state.window)) light::soften(*windowing, light);
  rotation_ = state.environmentRotation, discs_ = state.discs, window_ = state.window;
  return world_.emplace(std::move(light));
}

sh::RgbCoefficients StateLight::asset(const ViewState& state) {
  const Mat3 assetFromWorld = matrixOf(state.objectRotation).transpose().cast<float>();
  return sh::rotate(assetFromWorld, world(state));
}

}  // namespace lambent::view
