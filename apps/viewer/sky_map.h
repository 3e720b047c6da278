// A small map of the light in the world: the environment as it is turned, and the discs on it,
// which can be placed and dragged.
#pragma once

#include <array>
#include <optional>

#include "apps/viewer/session.h"
#include "lambent/render/gl_objects.h"

namespace lambent::viewer {

class SkyMap {
 public:
  /// Draws the map into ImGui's window, as wide as it is. A click on the sky adds a disc there; a
  /// click on a disc chooses it, and a drag moves it.
  void draw(Session& session);

 private:
  void paint(const Session& session);

  render::Texture texture_;
  /// What it was painted for.
  std::optional<std::pair<std::string, std::array<double, 4>>> painted_;
  int dragged_ = -1;
};

}  // namespace lambent::viewer
