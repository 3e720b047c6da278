// How the window is divided: the picture on the left, the panel on the right.
#pragma once

#include "apps/viewer/gl_window.h"

namespace lambent::viewer {

struct Layout {
  PixelSize pixels;         ///< of the framebuffer
  PixelSize window;         ///< in units of the mouse, and of everything that ImGui draws
  int panel = 0;            ///< width in these units; 0: hidden
  float scale = 1.0f;       ///< how much larger than at 96 dpi things are drawn, in these units
  PixelSize picture;        ///< in pixels
  float pixelsPerUnit = 1;  ///< of the framebuffer, in one unit

  PixelSize pictureUnits() const { return {window.width - panel, window.height}; }
};

Layout layOut(const GlWindow& window, bool panel);

}  // namespace lambent::viewer
