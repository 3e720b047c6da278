// Dear ImGui in a window: its context and its two backends, as one thing that goes when its owner
// goes.
#pragma once

#include "apps/viewer/gl_window.h"

namespace lambent::viewer {

class UserInterface {
 public:
  explicit UserInterface(GlWindow& window);
  ~UserInterface();
  UserInterface(const UserInterface&) = delete;
  UserInterface& operator=(const UserInterface&) = delete;

  /// Between these two everything is laid out anew, in every frame.
  void begin(float scale);
  void end();  ///< draws it to the framebuffer that is bound

 private:
  float scale_ = 0.0f;
};

}  // namespace lambent::viewer
