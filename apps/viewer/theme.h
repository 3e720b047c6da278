// How the panel looks: dark, quiet, legible.
#pragma once

namespace lambent::viewer {

/// Sets ImGui's colours, spacing and font for a display of this scale (1: 96 dpi). Before the first
/// frame, or between two.
void applyTheme(float scale);

}  // namespace lambent::viewer
