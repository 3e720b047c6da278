#include "lambent/view/state_light.h"

#include <gtest/gtest.h>

#include "lambent/light/windowing.h"
#include "lambent/view/placement.h"

namespace lambent::view {
namespace {

ViewState turnedWithTwoDiscs() {
  ViewState state;
  state.objectRotation = turned({0, 0, 0, 1}, Vec3d(1, 2, -1).normalized(), 0.8);
  state.environmentRotation = turned({0, 0, 0, 1}, Vec3d(0, 1, 0.3).normalized(), -1.9);
  state.discs = {{70, 20, 40, Rgb(5, 4, 3)}, {-100, -50, 15, Rgb(0, 9, 1)}};
  return state;
}

light::Environment sky() {
  return light::Environment::uniform(Rgb(0.2f, 0.3f, 0.4f)) +
         light::Environment::disc(Vec3(0.6f, 0.64f, 0.48f), 0.7, Rgb(4, 3, 2)) +
         light::Environment::clampedCosine(Vec3(0, -0.8f, 0.6f), Rgb(0.1f, 0.5f, 0.2f));
}

void expectSame(const sh::RgbCoefficients& a, const sh::RgbCoefficients& b) {
  ASSERT_EQ(a.bands, b.bands);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    EXPECT_NEAR(a.values[i], b.values[i], 2e-5) << i;
}

TEST(StateLight, IsTheProjectionOfWhatTheAssetSees) {
  for (const int bands : {1, 4, 5, 7}) {
    StateLight light(sky(), bands);
    const ViewState state = turnedWithTwoDiscs();
    expectSame(light.asset(state), assetEnvironment(state, sky()).project(bands));
  }
}

TEST(StateLight, TakesTheWindowOfTheWhole) {
  for (const char* window : {"hann:6", "lanczos", "minimal"}) {
    StateLight light(sky(), 5);
    ViewState state = turnedWithTwoDiscs();
    state.window = window;
    sh::RgbCoefficients expected = assetEnvironment(state, sky()).project(5);
    const sh::RgbCoefficients hard = expected;
    light::soften(*light::parseWindowing(window), expected);
    EXPECT_NE(expected.values, hard.values);
    expectSame(light.asset(state), expected);
  }
}

TEST(StateLight, FollowsEveryChange) {
  StateLight kept(sky(), 5);
  ViewState state = turnedWithTwoDiscs();
  const auto fresh = [&] { return StateLight(sky(), 5).asset(state); };
  expectSame(kept.asset(state), fresh());
  state.discs[1].radiance = Rgb(1, 1, 1);
  expectSame(kept.asset(state), fresh());
  state.discs.pop_back();
  expectSame(kept.asset(state), fresh());
  state.environmentRotation = {0, 1, 0, 0};
  expectSame(kept.asset(state), fresh());
  state.window = "hann";
  expectSame(kept.asset(state), fresh());
  state.objectRotation = {1, 0, 0, 0};
  expectSame(kept.asset(state), fresh());
}

}  // namespace
}  // namespace lambent::view
