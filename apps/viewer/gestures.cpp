#include "apps/viewer/gestures.h"

#include <imgui.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/view/orbit.h"

namespace lambent::viewer {

namespace {

constexpr double kTurnPerHeight = kPi;  // a drag over the whole height is half a turn

struct CameraAxes {
  Vec3d right, up;
};

CameraAxes axesOf(const Session& session, const PixelSize& picture) {
  const Mat4 world = session.stage.camera(session.state, picture).worldFromCamera;
  return {world.block<3, 1>(0, 0).cast<double>().normalized(),
          world.block<3, 1>(0, 1).cast<double>().normalized()};
}

Gesture::Kind kindOfDrag(const ImGuiIO& io) {
  using Kind = Gesture::Kind;
  const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  const bool other =
      ImGui::IsMouseDown(ImGuiMouseButton_Middle) || ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (left && io.KeyShift) return Kind::TurnEnvironment;
  if (left && io.KeyCtrl) return Kind::TurnObject;
  if (left) return Kind::Orbit;
  if (other && io.KeyCtrl) return Kind::MoveObject;
  return other ? Kind::Pan : Kind::None;
}

}  // namespace

void apply(Session& session, const Gesture& gesture, const PixelSize& picture) {
  const double dx = kTurnPerHeight * double(gesture.drag.x());
  const double dy = kTurnPerHeight * double(gesture.drag.y());
  const auto change = [&](auto&& changed) {
    view::LookAt& hand = session.hand(picture);
    hand = changed(hand);
  };
  switch (gesture.kind) {
    case Gesture::Kind::None:
      return;
    case Gesture::Kind::Orbit:  // the object follows the hand, so the camera goes the other way
      return change([&](const view::LookAt& hand) { return view::orbited(hand, -dx, -dy); });
    case Gesture::Kind::Pan:
      return change([&](const view::LookAt& hand) { return view::panned(hand, gesture.drag); });
    case Gesture::Kind::Zoom: {
      const double size =
          session.stage.empty() ? 1.0 : double(session.stage.bounds(session.state).diagonal());
      return change([&](const view::LookAt& hand) {
        return view::zoomed(hand, std::pow(0.87, double(gesture.wheel)), gesture.at, 0.01 * size,
                            100.0 * size);
      });
    }
    case Gesture::Kind::TurnEnvironment:  // what is behind the object follows the hand
      session.turnEnvironment(Vec3d::UnitY(), -dx);
      return session.turnEnvironment(axesOf(session, picture).right, dy);
    case Gesture::Kind::TurnObject: {
      const CameraAxes axes = axesOf(session, picture);
      session.turnObject(axes.up, dx);
      return session.turnObject(axes.right, -dy);
    }
    case Gesture::Kind::MoveObject: {
      const view::LookAt& hand = session.hand(picture);
      session.state.objectTranslation -= view::panned(hand, gesture.drag).target - hand.target;
      return;
    }
  }
}

void followMouse(Session& session, const Layout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse || session.stage.empty()) return;
  const PixelSize& picture = layout.picture;
  const float width = float(layout.pictureUnits().width);
  const float height = float(std::max(layout.pictureUnits().height, 1));
  Gesture gesture{kindOfDrag(io), Vec2(io.MouseDelta.x, -io.MouseDelta.y) / height,
                  Vec2(io.MousePos.x - 0.5f * width, 0.5f * height - io.MousePos.y) / height,
                  io.MouseWheel};
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return session.frameAll(picture);
  if (gesture.kind != Gesture::Kind::None && gesture.drag != Vec2::Zero())
    apply(session, gesture, picture);
  if (gesture.wheel != 0.0f) {
    gesture.kind = Gesture::Kind::Zoom;
    apply(session, gesture, picture);
  }
}

std::span<const std::pair<const char*, const char*>> gestureHelp() {
  static constexpr std::array<std::pair<const char*, const char*>, 7> kHelp = {{
      {"Drag", "walk around the object"},
      {"Right drag", "move the view"},
      {"Wheel", "zoom towards the pointer"},
      {"Double click", "frame the whole object"},
      {"Shift + drag", "turn the environment"},
      {"Ctrl + drag", "turn the object"},
      {"Ctrl + right drag", "move the object"},
  }};
  return kHelp;
}

}  // namespace lambent::viewer
