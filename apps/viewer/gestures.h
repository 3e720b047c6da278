// What the mouse does on the picture.
#pragma once

#include <span>
#include <utility>

#include "apps/viewer/layout.h"
#include "apps/viewer/session.h"

namespace lambent::viewer {

/// A movement over the picture: `drag` and `at` in heights of the picture, y upwards, `at` from its
/// middle.
struct Gesture {
  enum class Kind { None, Orbit, Pan, Zoom, TurnEnvironment, TurnObject, MoveObject } kind;
  Vec2 drag = Vec2::Zero();
  Vec2 at = Vec2::Zero();
  float wheel = 0.0f;  ///< notches, > 0 nearer
};

void apply(Session& session, const Gesture& gesture, const PixelSize& picture);
/// Reads ImGui's mouse; does nothing while the panel has it.
void followMouse(Session& session, const Layout& layout);

/// Each button and wheel with what it does, for the help.
std::span<const std::pair<const char*, const char*>> gestureHelp();

}  // namespace lambent::viewer
