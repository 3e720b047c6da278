// A sheet of pictures in rows and columns with labels, as papers print them.
#pragma once

#include <string>
#include <vector>

#include "lambent/image/image.h"

namespace lambent::figures {

/// Draws text in dark grey on the image, its upper left corner at (x, y); letters are 7·scale high.
void drawText(image::Image& image, int x, int y, const std::string& text, int scale = 2);
int textWidth(const std::string& text, int scale = 2);

/// Cells (display-referred, linear in [0, 1]), all columns as wide as the widest, each row as high
/// as its highest.
struct Sheet {
  std::vector<std::string> columnLabels, rowLabels;
  std::vector<std::vector<image::Image>> rows;
};
image::Image compose(const Sheet& sheet);

}  // namespace lambent::figures
