#include "apps/viewer/layout.h"

#include <algorithm>
#include <cmath>

namespace lambent::viewer {

namespace {
constexpr float kPanelWidth = 316.0f;  // at scale 1
}

Layout layOut(const GlWindow& window, bool panel) {
  Layout layout;
  layout.pixels = window.framebufferSize();
  layout.window = window.size();
  layout.scale = window.contentScale();
  layout.pixelsPerUnit = float(layout.pixels.width) / float(std::max(layout.window.width, 1));
  if (panel)
    layout.panel =
        std::clamp(int(std::lround(kPanelWidth * layout.scale)), 0, layout.window.width - 1);
  const int taken = int(std::lround(float(layout.panel) * layout.pixelsPerUnit));
  layout.picture = {std::max(layout.pixels.width - taken, 1), std::max(layout.pixels.height, 1)};
  return layout;
}

}  // namespace lambent::viewer
