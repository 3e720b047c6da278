// Line plots: axes with ticks, series, a legend.
#pragma once

#include <string>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/math/types.h"

namespace lambent::figures {

struct Series {
  enum class Style { Line, Dashes, Dots };
  std::string name;  ///< in the legend; empty: not in it
  /// What is not finite, or not above 0 on a logarithmic axis, breaks the line.
  std::vector<Eigen::Vector2d> points;
  Rgb color = Rgb::Zero();  ///< linear
  Style style = Style::Line;
  double width = 1.6;  ///< of lines, and radius of dots, pixels
};

struct Axis {
  std::string label;
  double least = 0, most = 1;
  bool logarithmic = false;
  double step = 0;  ///< between two ticks; 0: some five of them. Of logarithmic axes: a decade each
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  int width = 400, height = 300;
  bool legend = true;  ///< within the frame, in the corner that the points leave most room
};

/// Dark on white. Letters are 7 or 14 pixels high.
image::Image draw(const Plot& plot);

/// The names of the series beside samples of their lines, in as many columns as fit.
image::Image legendOf(const std::vector<Series>& series, int width);

/// Colours that can be told apart, the first of them dark; they begin again after twelve.
Rgb seriesColor(std::size_t index);

}  // namespace lambent::figures
