#include "figures/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/sheet.h"

namespace lambent::figures {
namespace {

using Point = Eigen::Vector2d;

constexpr int kTextHeight = 10, kMargin = 8, kSample = 26;
const Rgb kGrid = Rgb::Constant(0.80f), kFrame = Rgb::Constant(0.25f);

struct Frame {
  double left, top, right, bottom;
};

void blend(image::Image& image, int x, int y, const Rgb& color, double coverage) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || coverage <= 0) return;
  Rgb& pixel = image.at(x, y);
  pixel += (color - pixel) * float(std::min(coverage, 1.0));
}

/// How much of a pixel lies within `radius` of a segment, with a soft border of one pixel.
template <class CoverageAt>
void stroke(const Frame& clip, const Point& a, const Point& b, double radius,
            const CoverageAt& coverageAt) {
  const int x0 = int(std::floor(std::max(clip.left, std::min(a.x(), b.x()) - radius - 1)));
  const int x1 = int(std::ceil(std::min(clip.right, std::max(a.x(), b.x()) + radius + 1)));
  const int y0 = int(std::floor(std::max(clip.top, std::min(a.y(), b.y()) - radius - 1)));
  const int y1 = int(std::ceil(std::min(clip.bottom, std::max(a.y(), b.y()) + radius + 1)));
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) coverageAt(x, y);
}

/// One polyline at a time, so that segments that meet do not darken their joint.
void drawLine(image::Image& image, const Frame& clip, const std::vector<Point>& line,
              const Series& series) {
  std::vector<float> coverage(std::size_t(image.width) * image.height, 0.0f);
  double along = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point a = line[i - 1], d = line[i] - a;
    const double length = d.norm();
    stroke(clip, a, line[i], series.width / 2, [&](int x, int y) {
      const Point p(x + .5, y + .5);
      const double t = length > 0 ? std::clamp((p - a).dot(d) / (length * length), 0.0, 1.0) : 0.0;
      double here = series.width / 2 + .5 - (p - (a + t * d)).norm();
      if (series.style == Series::Style::Dashes && std::fmod(along + t * length, 10) > 6) here = 0;
      float& at = coverage[std::size_t(y) * image.width + x];
      at = std::max(at, float(std::clamp(here, 0.0, 1.0)));
    });
    along += length;
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      blend(image, x, y, series.color, coverage[std::size_t(y) * image.width + x]);
}

void drawDot(image::Image& image, const Frame& clip, const Point& at, const Series& series) {
  stroke(clip, at, at, series.width, [&](int x, int y) {
    blend(image, x, y, series.color, series.width + .5 - (Point(x + .5, y + .5) - at).norm());
  });
}

void horizontal(image::Image& image, double x0, double x1, double y, const Rgb& color) {
  for (int x = int(x0); x < int(x1); ++x) blend(image, x, int(y), color, 1);
}
void vertical(image::Image& image, double x, double y0, double y1, const Rgb& color) {
  for (int y = int(y0); y < int(y1); ++y) blend(image, int(x), y, color, 1);
}

struct Tick {
  double value;
  std::string label;
};

std::vector<Tick> ticksOf(const Axis& axis) {
  std::vector<Tick> ticks;
  if (axis.logarithmic) {
    const int first = int(std::ceil(std::log10(axis.least) - 1e-9));
    const int last = int(std::floor(std::log10(axis.most) + 1e-9));
    const int every = std::max(1, (last - first + 5) / 6);
    for (int decade = first; decade <= last; ++decade) {
      const double value = std::pow(10, decade);
      const bool named = (decade - first) % every == 0;
      ticks.push_back({value, !named                       ? std::string()
                              : decade >= -3 && decade < 5 ? fmt::format("{:g}", value)
                                                           : fmt::format("1e{}", decade)});
    }
    return ticks;
  }
  double step = axis.step;
  if (step <= 0) {
    const double rough = (axis.most - axis.least) / 5,
                 unit = std::pow(10, std::floor(std::log10(rough)));
    step = unit * (rough / unit < 1.5 ? 1 : rough / unit < 3.5 ? 2 : rough / unit < 7.5 ? 5 : 10);
  }
  for (double k = std::ceil(axis.least / step - 1e-9); k * step <= axis.most + 1e-9 * step; ++k)
    ticks.push_back({k * step, fmt::format("{:g}", std::round(k * step * 1e9) / 1e9 + 0.0)});
  return ticks;
}

double placeOf(const Axis& axis, double value) {
  if (axis.logarithmic)
    return value > 0 ? std::log(value / axis.least) / std::log(axis.most / axis.least)
                     : std::nan("");
  return (value - axis.least) / (axis.most - axis.least);
}

void drawSample(image::Image& image, int x, int y, const Series& series) {
  const Frame all{0, 0, double(image.width), double(image.height)};
  const Point middle(x + kSample / 2., y + 4);
  if (series.style == Series::Style::Dots)
    drawDot(image, all, middle, series);
  else
    drawLine(image, all, {Point(x, y + 4), Point(x + kSample - 4, y + 4)}, series);
  drawText(image, x + kSample, y, series.name, 1);
}

std::vector<const Series*> named(const std::vector<Series>& series) {
  std::vector<const Series*> out;
  for (const Series& s : series)
    if (!s.name.empty()) out.push_back(&s);
  return out;
}

int legendWidth(const std::vector<const Series*>& series) {
  int width = 0;
  for (const Series* s : series) width = std::max(width, textWidth(s->name, 1));
  return width + kSample + kMargin;
}

void drawLegend(image::Image& image, const Frame& frame, const std::vector<Series>& series,
                const std::vector<Point>& taken) {
  const std::vector<const Series*> shown = named(series);
  if (shown.empty()) return;
  const double width = legendWidth(shown) + kMargin;
  const double height = double(shown.size()) * (kTextHeight + 3) + kMargin;
  Frame best{};
  std::size_t fewest = taken.size() + 1;
  for (const bool top : {true, false})
    for (const bool right : {true, false}) {
      Frame box;
      box.left = right ? frame.right - width - 4 : frame.left + 4;
      box.top = top ? frame.top + 4 : frame.bottom - height - 4;
      box.right = box.left + width, box.bottom = box.top + height;
      const auto inside =
          std::size_t(std::count_if(taken.begin(), taken.end(), [&](const Point& p) {
            return p.x() > box.left - 4 && p.x() < box.right + 4 && p.y() > box.top - 4 &&
                   p.y() < box.bottom + 4;
          }));
      if (inside < fewest) fewest = inside, best = box;
    }
  for (int y = int(best.top); y < int(best.bottom); ++y)
    for (int x = int(best.left); x < int(best.right); ++x) blend(image, x, y, Rgb::Ones(), .85);
  for (std::size_t i = 0; i < shown.size(); ++i)
    drawSample(image, int(best.left) + kMargin, int(best.top) + 6 + int(i) * (kTextHeight + 3),
               *shown[i]);
}

}  // namespace

Rgb seriesColor(std::size_t index) {
  static const std::array<Rgb, 12> colors = {
      Rgb(0.01f, 0.01f, 0.02f), Rgb(0.70f, 0.02f, 0.02f), Rgb(0.01f, 0.15f, 0.60f),
      Rgb(0.02f, 0.32f, 0.04f), Rgb(0.85f, 0.24f, 0.00f), Rgb(0.27f, 0.04f, 0.42f),
      Rgb(0.00f, 0.40f, 0.50f), Rgb(0.75f, 0.10f, 0.35f), Rgb(0.35f, 0.25f, 0.00f),
      Rgb(0.30f, 0.30f, 0.30f), Rgb(0.25f, 0.50f, 0.05f), Rgb(0.25f, 0.40f, 0.90f)};
  return colors[index % colors.size()];
}

image::Image draw(const Plot& plot) {
  image::Image image(plot.width, plot.height);
  std::fill(image.pixels.begin(), image.pixels.end(), Rgb::Ones().eval());
  const std::vector<Tick> xTicks = ticksOf(plot.x), yTicks = ticksOf(plot.y);
  int labels = 0;
  for (const Tick& tick : yTicks) labels = std::max(labels, textWidth(tick.label, 1));
  const Frame frame{
      double(labels + kMargin + 6),
      double(kMargin + (plot.title.empty() ? 0 : 2 * kTextHeight) +
             (plot.y.label.empty() ? 0 : kTextHeight + 2)),
      double(plot.width - kMargin - 6),
      double(plot.height - kMargin - kTextHeight - (plot.x.label.empty() ? 0 : kTextHeight + 4))};
  const auto at = [&](const Point& value) {
    return Point(frame.left + placeOf(plot.x, value.x()) * (frame.right - frame.left),
                 frame.bottom - placeOf(plot.y, value.y()) * (frame.bottom - frame.top));
  };
  for (const Tick& tick : xTicks) {
    const double x = at({tick.value, plot.y.least}).x();
    vertical(image, x, frame.top, frame.bottom, kGrid);
    drawText(image, int(x) - textWidth(tick.label, 1) / 2, int(frame.bottom) + 5, tick.label, 1);
  }
  for (const Tick& tick : yTicks) {
    const double y = at({plot.x.least, tick.value}).y();
    horizontal(image, frame.left, frame.right, y, kGrid);
    drawText(image, int(frame.left) - 5 - textWidth(tick.label, 1), int(y) - 4, tick.label, 1);
  }
  std::vector<Point> taken;
  for (const Series& series : plot.series) {
    std::vector<Point> line;
    const auto end = [&] {
      if (line.size() > 1) drawLine(image, frame, line, series);
      line.clear();
    };
    for (const Point& value : series.points) {
      const Point place = at(value);
      if (!place.allFinite()) {
        end();
        continue;
      }
      taken.push_back(place);
      if (series.style == Series::Style::Dots)
        drawDot(image, frame, place, series);
      else
        line.push_back(place);
    }
    end();
  }
  horizontal(image, frame.left, frame.right, frame.top, kFrame);
  horizontal(image, frame.left, frame.right + 1, frame.bottom, kFrame);
  vertical(image, frame.left, frame.top, frame.bottom, kFrame);
  vertical(image, frame.right, frame.top, frame.bottom, kFrame);
  if (plot.legend) drawLegend(image, frame, plot.series, taken);
  const int centre = int(frame.left + frame.right) / 2;
  if (!plot.title.empty())
    drawText(image, centre - textWidth(plot.title, 2) / 2, kMargin / 2, plot.title, 2);
  if (!plot.y.label.empty())
    drawText(image, kMargin / 2, int(frame.top) - kTextHeight - 3, plot.y.label, 1);
  if (!plot.x.label.empty())
    drawText(image, centre - textWidth(plot.x.label, 1) / 2, plot.height - kTextHeight - 3,
             plot.x.label, 1);
  return image;
}

image::Image legendOf(const std::vector<Series>& series, int width) {
  const std::vector<const Series*> shown = named(series);
  const int each = legendWidth(shown) + kMargin, columns = std::max(1, width / each);
  const int rows = (int(shown.size()) + columns - 1) / columns;
  image::Image image(width, rows * (kTextHeight + 4) + kMargin);
  std::fill(image.pixels.begin(), image.pixels.end(), Rgb::Ones().eval());
  for (int i = 0; i < int(shown.size()); ++i)
    drawSample(image, (i % columns) * each + kMargin,
               (i / columns) * (kTextHeight + 4) + kMargin / 2, *shown[std::size_t(i)]);
  return image;
}

}  // namespace lambent::figures
