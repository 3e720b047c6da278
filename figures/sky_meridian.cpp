// Luminance along the solar meridian, by every model and in few bands of harmonics.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "figures/plot.h"
#include "figures/sheet.h"
#include "figures/sky.h"
#include "lambent/sh/basis.h"
#include "lambent/sky/sky_light.h"

namespace lambent::figures {
namespace {

const std::vector<double> kSuns = {0, 15, 30, 45, 60, 75, 85, 90, 94, 96, 102, 108};

struct Shown {
  std::string name;
  sky::Model model;
  int cieType = 12;
};
const std::vector<Shown> kShown = {{"fast", sky::Model::Fast},
                                   {"exact (60 and 94 alone)", sky::Model::Exact},
                                   {"Preetham", sky::Model::Preetham},
                                   {"Perez", sky::Model::Perez},
                                   {"ASRC-CIE", sky::Model::AsrcCie},
                                   {"CIE clear (1973)", sky::Model::CieClear},
                                   {"CIE overcast", sky::Model::CieOvercast},
                                   {"CIE type 1", sky::Model::CieGeneral, 1},
                                   {"CIE type 5", sky::Model::CieGeneral, 5},
                                   {"CIE type 8", sky::Model::CieGeneral, 8},
                                   {"CIE type 12", sky::Model::CieGeneral, 12},
                                   {"CIE type 15", sky::Model::CieGeneral, 15}};

bool isExactCheap(double sun) {
  return sun == 60 || sun == 94;
}

/// cd m⁻² by the angle from the zenith, −89.5 … 89.5°, positive towards the Sun.
template <class LuminanceAt>
std::vector<Eigen::Vector2d> alongMeridian(const LuminanceAt& luminanceAt) {
  std::vector<Eigen::Vector2d> points;
  for (double view = -89.5; view <= 89.6; view += .5)
    points.emplace_back(view, luminanceAt(skyDirection(view, 0)));
  return points;
}

/// Whole decades that hold the first series, and of the others what is less than four decades below
/// the highest.
Axis luminanceAxis(const std::vector<Series>& series) {
  Axis axis{.label = "cd/m2", .logarithmic = true};
  const auto outermost = [](const std::vector<Eigen::Vector2d>& points) {
    double least = 1e300, most = 0;
    for (const Eigen::Vector2d& p : points)
      if (p.y() > 0) least = std::min(least, p.y()), most = std::max(most, p.y());
    return std::pair(std::pow(10, std::floor(std::log10(least))),
                     std::pow(10, std::ceil(std::log10(most))));
  };
  std::tie(axis.least, axis.most) = outermost(series.front().points);
  for (const Series& s : series) axis.most = std::max(axis.most, outermost(s.points).second);
  const double limit = axis.most * 1e-4;
  for (const Series& s : series)
    axis.least = std::min(axis.least, std::max(limit, outermost(s.points).first));
  return axis;
}

image::Image panel(double sun, std::vector<Series> series) {
  Plot plot;
  plot.title = fmt::format("Sun at {:g}", sun);
  plot.x = {
      .label = "angle from the zenith, towards the Sun", .least = -90, .most = 90, .step = 30};
  plot.y = luminanceAxis(series);
  plot.series = std::move(series);
  plot.width = 340, plot.height = 230, plot.legend = false;
  return draw(plot);
}

/// Panels in rows of three with one legend below them.
image::Image pageOf(const std::vector<image::Image>& panels, const std::vector<Series>& legend) {
  Sheet sheet;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i % 3 == 0) sheet.rows.emplace_back();
    sheet.rows.back().push_back(panels[i]);
  }
  image::Image page = compose(sheet);
  const image::Image names = legendOf(legend, page.width - 20);
  image::Image out(page.width, page.height + names.height);
  std::fill(out.pixels.begin(), out.pixels.end(), Rgb::Ones().eval());
  std::copy(page.pixels.begin(), page.pixels.end(), out.pixels.begin());
  for (int y = 0; y < names.height; ++y)
    for (int x = 0; x < names.width; ++x) out.at(x + 10, page.height + y) = names.at(x, y);
  return out;
}

Series seriesOf(std::size_t index, const std::string& name) {
  Series series;
  series.name = name, series.color = seriesColor(index);
  if (index == 0) series.width = 3;
  if (name.starts_with("CIE type")) series.style = Series::Style::Dashes;
  return series;
}

void everyModel(const Studio& studio) {
  const std::vector<double> views = {-80, -60, -30, 0, 30, 60, 80};
  std::vector<std::string> zeniths(kShown.size());
  std::vector<image::Image> panels;
  std::vector<Series> legend;
  fmt::print("luminance along the meridian of the simulation, cd/m²\n| Sun |");
  for (const double view : views) fmt::print(" {:g}° |", view);
  fmt::print("\n|---|---|---|---|---|---|---|---|\n");
  for (const double sun : kSuns) {
    std::vector<Series> series;
    for (std::size_t m = 0; m < kShown.size(); ++m) {
      Series s = seriesOf(m, kShown[m].name);
      if (sun == kSuns.front()) legend.push_back(s);
      if (kShown[m].model == sky::Model::Exact && (!isExactCheap(sun) || studio.quick)) {
        zeniths[m] += " |";
        continue;
      }
      sky::SkyOptions options = skyOptions("reference", kShown[m].model, sun);
      options.cieType = kShown[m].cieType;
      const sky::Sky made = skyOf(options);
      const auto luminanceAt = [&](const Vec3d& d) { return made.dome->color(d)[1]; };
      s.points = alongMeridian(luminanceAt);
      zeniths[m] += fmt::format(" {:.4g} |", luminanceAt(Vec3d(0, 1, 0)));
      if (kShown[m].model == sky::Model::Exact) {
        // Few enough that what they lie on is seen between them.
        std::vector<Eigen::Vector2d> few;
        for (std::size_t i = 5; i < s.points.size(); i += 12) few.push_back(s.points[i]);
        s.points = std::move(few);
        s.width = 2.2, s.style = Series::Style::Dots;
      }
      if (m == 0) {
        fmt::print("| {:g}° |", sun);
        for (const double view : views) fmt::print(" {:.4g} |", luminanceAt(skyDirection(view, 0)));
        fmt::print("\n");
      }
      series.push_back(std::move(s));
    }
    panels.push_back(panel(sun, std::move(series)));
  }
  legend[1].style = Series::Style::Dots, legend[1].width = 2.2;
  studio.save(pageOf(panels, legend), "sky-meridian");
  fmt::print("\nluminance of the zenith, cd/m²\n| model |");
  for (const double sun : kSuns) fmt::print(" {:g}° |", sun);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < kSuns.size(); ++i) fmt::print("---|");
  fmt::print("\n");
  for (std::size_t m = 0; m < kShown.size(); ++m)
    fmt::print("| {} |{}\n", kShown[m].name, zeniths[m]);
}

void inHarmonics(const Studio& studio) {
  const std::vector<int> bands = {3, 5, 9};
  std::vector<image::Image> panels;
  std::vector<Series> legend;
  fmt::print(
      "\nthe simulation in bands of harmonics along the meridian within 85° of the zenith: "
      "rms of the difference over rms luminance; largest; least value over the same\n"
      "| Sun | 3 bands | 5 bands | 9 bands |\n|---|---|---|---|\n");
  for (const double sun : kSuns) {
    const sky::Sky made = skyOf(skyOptions("reference", sky::Model::Fast, sun));
    std::vector<Series> series = {seriesOf(0, "fast")};
    series[0].points = alongMeridian([&](const Vec3d& d) { return made.dome->color(d)[1]; });
    fmt::print("| {:g}° |", sun);
    for (std::size_t b = 0; b < bands.size(); ++b) {
      const auto count = std::size_t(sh::coefficientCount(bands[b]));
      const std::vector<double> xyz = sky::projectDome(*made.dome, made.horizon, bands[b]);
      std::vector<double> basis(count);
      Series s = seriesOf(b + 1, fmt::format("{} bands", bands[b]));
      s.points = alongMeridian([&](const Vec3d& d) {
        sh::evaluate(bands[b], d, std::span<double>(basis));
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += xyz[count + i] * basis[i];
        return sum;
      });
      double difference = 0, power = 0, largest = 0, least = 1e300;
      int within = 0;
      for (std::size_t i = 0; i < s.points.size(); ++i) {
        if (std::abs(s.points[i].x()) > 85) continue;
        const double truth = series[0].points[i].y(), off = s.points[i].y() - truth;
        difference += off * off, power += truth * truth, ++within;
        largest = std::max(largest, std::abs(off)), least = std::min(least, s.points[i].y());
      }
      const double scale = std::sqrt(power / within);
      fmt::print(" {:.0f}% / {:.0f}% / {:+.0f}% |", 100 * std::sqrt(difference / power),
                 100 * largest / scale, 100 * least / scale);
      series.push_back(std::move(s));
    }
    fmt::print("\n");
    if (sun == kSuns.front()) legend = series;
    panels.push_back(panel(sun, std::move(series)));
  }
  studio.save(pageOf(panels, legend), "sky-meridian-harmonics");
}

}  // namespace

void skyMeridian(const Studio& studio) {
  everyModel(studio);
  inHarmonics(studio);
}

}  // namespace lambent::figures
