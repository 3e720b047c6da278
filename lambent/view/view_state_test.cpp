#include "lambent/view/view_state.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

namespace lambent::view {
namespace {

ViewState everything() {
  ViewState state;
  state.camera = LookAt{Vec3(0.1f, 2, 3.3f), Vec3(0, 1, 0), Vec3(0.1f, 1, 0), 35.5, 1.25};
  state.objectRotation = {0.5, -0.5, 0.5, 0.5};
  state.objectTranslation = Vec3(0.3f, -7e-8f, 12);
  state.environment = "studio \"a\".exr+disc:1,2,3";
  state.environmentRotation = {0, 0.6, 0, 0.8};
  state.discs = {{30, 45, 0.53, Rgb(2e4f, 1.9e4f, 0.1f)}, {-170, -90, 360, Rgb::Zero()}};
  state.window = "lanczos:6.5";
  state.transfer = transfer::Kind::Shadowed;
  state.sunShadow = shade::SunShadow::Soft;
  state.air = AirShown{0.3, true};
  state.macro = state.viewDependent = state.background = false;
  state.lobe = 12.5;
  state.exposure = -1.75;
  state.tone = tone::Curve::Linear;
  state.samples = 64;
  return state;
}

TEST(ViewState, ComesBackAsItWas) {
  for (const ViewState& state : {ViewState(), everything()}) {
    const auto back = parseViewState(toJson(state), "state.json");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(*back == state) << toJson(*back);
    EXPECT_EQ(toJson(*back), toJson(state));
  }
}

TEST(ViewState, IsComparedMemberByMember) {
  const ViewState state = everything();
  const auto differs = [&](auto change) {
    ViewState other = state;
    change(other);
    return !(other == state) && toJson(other) != toJson(state);
  };
  EXPECT_TRUE(differs([](ViewState& s) { s.camera->up.x() = 0.2f; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.camera.reset(); }));
  EXPECT_TRUE(differs([](ViewState& s) { s.objectRotation = {0, 0, 0, 1}; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.objectTranslation.y() = 1; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.environment = "uniform"; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.environmentRotation = {1, 0, 0, 0}; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.discs[1].radiance[2] = 1; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.window = "minimal"; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.transfer.reset(); }));
  EXPECT_TRUE(differs([](ViewState& s) { s.sunShadow = shade::SunShadow::Sharp; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.air.reset(); }));
  EXPECT_TRUE(differs([](ViewState& s) { s.air->metresPerUnit = 2; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.air->shafts = false; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.macro = true; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.viewDependent = true; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.lobe.reset(); }));
  EXPECT_TRUE(differs([](ViewState& s) { s.exposure = 0; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.tone = tone::Curve::Filmic; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.background = true; }));
  EXPECT_TRUE(differs([](ViewState& s) { s.samples = 1; }));
}

TEST(ViewState, NumbersHaveAsFewDigitsAsTheyNeed) {
  const std::string json = toJson(everything());
  EXPECT_NE(json.find("3.3]"), std::string::npos) << json;
  EXPECT_EQ(json.find("3.29999"), std::string::npos) << json;
}

TEST(ViewState, WhatIsMissingHasItsDefaultAndWhatIsUnknownIsPassedOver) {
  const auto state = parseViewState(
      R"({"lambent": "view", "later": [1], "exposure": 2, "camera": null,
          "discs": [{"elevation": 10}], "air": {}})",
      "state.json");
  ASSERT_TRUE(state) << state.error().message;
  ViewState expected;
  expected.exposure = 2;
  expected.discs = {Disc{0, 10, 20, Rgb::Ones()}};
  expected.air = AirShown();
  EXPECT_TRUE(*state == expected) << toJson(*state);
}

TEST(ViewState, RotationsAreMadeUnit) {
  const auto state = parseViewState(
      R"({"lambent": "view", "object": {"rotation": [0, 0.7071, 0, 0.7071]}})", "state.json");
  ASSERT_TRUE(state);
  const auto& q = state->objectRotation;
  EXPECT_NEAR(q[1] * q[1] + q[3] * q[3], 1.0, 1e-15);
}

TEST(ViewState, NamesTheMemberThatIsWrong) {
  const struct {
    const char* member;
    const char* text;
  } cases[] = {
      {"version", R"("version": 2)"},
      {"camera", R"("camera": 3)"},
      {"camera.position", R"("camera": {"position": [1, 2]})"},
      {"camera.position[1]", R"("camera": {"position": [1, "a", 2]})"},
      {"camera.target", R"("camera": {"position": [0, 0, 0], "target": [0, 0, 0]})"},
      {"camera.up", R"("camera": {"position": [0, 5, 0]})"},
      {"camera.up", R"("camera": {"up": [0, 0, 0]})"},
      {"camera.verticalFov", R"("camera": {"verticalFov": 180})"},
      {"camera.orthographicHalfHeight", R"("camera": {"orthographicHalfHeight": 0})"},
      {"object", R"("object": [])"},
      {"object.rotation", R"("object": {"rotation": [0, 0, 0, 2]})"},
      {"object.rotation", R"("object": {"rotation": [0, 0, 0, 0]})"},
      {"object.translation[2]", R"("object": {"translation": [0, 0, 1e39]})"},
      {"environment.source", R"("environment": {"source": 1})"},
      {"environment.source", R"("environment": {"source": ""})"},
      {"environment.rotation", R"("environment": {"rotation": [1, 1, 0, 0]})"},
      {"discs", R"("discs": {})"},
      {"discs[1]", R"("discs": [{}, 1])"},
      {"discs[0].diameter", R"("discs": [{"diameter": 0}])"},
      {"discs[0].elevation", R"("discs": [{"elevation": 91}])"},
      {"discs[0].radiance[1]", R"("discs": [{"radiance": [0, -1, 0]}])"},
      {"window", R"("window": "hann:-2")"},
      {"transfer", R"("transfer": "glossy")"},
      {"sunShadow", R"("sunShadow": "hard")"},
      {"air", R"("air": true)"},
      {"air.metresPerUnit", R"("air": {"metresPerUnit": 0})"},
      {"air.metresPerUnit", R"("air": {"metresPerUnit": null})"},
      {"air.shafts", R"("air": {"shafts": 16})"},
      {"macro", R"("macro": 1)"},
      {"viewDependent", R"("viewDependent": "on")"},
      {"lobe", R"("lobe": -1)"},
      {"exposure", R"("exposure": "auto")"},
      {"tone", R"("tone": "aces")"},
      {"background", R"("background": null)"},
      {"samples", R"("samples": 0)"},
      {"samples", R"("samples": 1.5)"},
  };
  for (const auto& each : cases) {
    const auto state =
        parseViewState(std::string(R"({"lambent": "view", )") + each.text + "}", "my.json");
    ASSERT_FALSE(state) << each.text;
    EXPECT_EQ(state.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(state.error().message.find("my.json: \"" + std::string(each.member) + "\""), 0u)
        << state.error().message;
  }
}

TEST(ViewState, OtherFilesAreRefused) {
  for (const char* text : {"", "{", "[]", "null", "{}", R"({"lambent": "light"})",
                           R"({"lambent": 1})", "\xff\xfe", R"({"lambent": "view"} x)"}) {
    const auto state = parseViewState(text, "my.json");
    ASSERT_FALSE(state) << text;
    EXPECT_EQ(state.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(state.error().message.find("my.json: "), 0u);
  }
  const auto missing = readViewState("/nowhere/state.json");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::BadInput);
}

TEST(ViewState, GoesThroughAFile) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("lambent-view-state-" + std::to_string(::getpid()) + ".json");
  const ViewState state = everything();
  ASSERT_TRUE(writeViewState(state, path));
  const auto back = readViewState(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(*back == state);
}

}  // namespace
}  // namespace lambent::view
