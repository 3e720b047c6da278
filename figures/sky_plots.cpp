// Optical lengths, colours of clear skies, compact skies.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/plot.h"
#include "figures/sheet.h"
#include "figures/sky.h"
#include "lambent/media/optical_length.h"
#include "lambent/sky/air_mass.h"
#include "lambent/sky/compact_sky.h"

namespace lambent::figures {

namespace {

using Points = std::vector<Eigen::Vector2d>;

Series curve(const std::string& name, std::size_t color, Points points,
             Series::Style style = Series::Style::Line, double width = 1.6) {
  return {name, std::move(points), seriesColor(color), style, width};
}

}  // namespace

void skyOpticalLengths(const Studio& studio) {
  constexpr double kRadius = 6.36e6, kAir = 8400, kAerosol = 1250;
  const auto exact = [](double height, double zenith) {
    return height * media::chapman(kRadius / height, zenith * kDegree);
  };
  const auto kasten = [](double zenith) { return sky::kastenAirMass((90 - zenith) * kDegree); };
  std::array<Points, 6> points;
  for (double z = 0; z <= 90; z += .25) {
    const double flat = z < 90 ? 1 / std::cos(z * kDegree) : std::nan("");
    const std::array<double, 6> metres = {exact(kAir, z),       kAir * kasten(z),
                                          kAir * flat,          exact(kAerosol, z),
                                          kAerosol * kasten(z), kAerosol * flat};
    for (std::size_t i = 0; i < metres.size(); ++i) points[i].emplace_back(z, metres[i] / 1000);
  }
  Plot plot;
  plot.x = {.label = "angle from the zenith, degrees", .least = 0, .most = 90, .step = 10};
  plot.y = {.label = "optical length, km", .least = 1, .most = 1000, .logarithmic = true};
  const Series::Style dashes = Series::Style::Dashes;
  plot.series = {curve("molecules, H = 8.4 km", 2, points[0], Series::Style::Line, 2.4),
                 curve("  by Kasten's formula", 1, points[1], dashes),
                 curve("  flat Earth", 9, points[2], dashes, 1),
                 curve("aerosols, H = 1.25 km", 4, points[3], Series::Style::Line, 2.4),
                 curve("  by Kasten's formula", 1, points[4], dashes),
                 curve("  flat Earth", 9, points[5], dashes, 1)};
  plot.width = 640, plot.height = 420;
  studio.save(draw(plot), "sky-optical-lengths");
  fmt::print(
      "optical lengths, km; in brackets over that to the zenith\n"
      "| angle from the zenith | molecules | aerosols | Kasten's ratio |\n|---|---|---|---|\n");
  for (const double z : {0., 30., 60., 75., 80., 85., 88., 89., 90.}) {
    const double air = exact(kAir, z), aerosol = exact(kAerosol, z);
    fmt::print("| {:g}° | {:.4g} ({:.4g}) | {:.4g} ({:.4g}) | {:.4g} |\n", z, air / 1000,
               air / kAir, aerosol / 1000, aerosol / kAerosol, kasten(z));
  }
}

namespace {

/// x and y of judd1964spectral's daylight of 4000 … 25000 K.
Points daylightLocus() {
  Points points;
  for (double mired = 40; mired <= 250; mired += 1) {
    const double t = 1e6 / mired, u = 1e3 / t;
    const double x = t <= 7000 ? .244063 + u * (.09911 + u * (2.9678 - 4.6070 * u))
                               : .237040 + u * (.24748 + u * (1.9018 - 2.0064 * u));
    points.emplace_back(x, -3 * x * x + 2.87 * x - .275);
  }
  return points;
}

Points spectralLocus() {
  Points points;
  for (double nm = 400; nm <= 700; nm += 5) {
    const Vec3d xyz = radiometry::cie1931(nm);
    points.emplace_back(xyz.x() / xyz.sum(), xyz.y() / xyz.sum());
  }
  points.push_back(points.front());
  return points;
}

double distanceTo(const Points& line, const Eigen::Vector2d& p) {
  double least = 1e300;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d d = line[i] - line[i - 1];
    const double t = std::clamp((p - line[i - 1]).dot(d) / d.squaredNorm(), 0., 1.);
    least = std::min(least, (p - line[i - 1] - t * d).norm());
  }
  return least;
}

Points coloursOf(const sky::Sky& sky) {
  Points points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 10; ++j) {
      const auto c =
          sky.dome->color(skyDirection(std::acos((i + .5) / 12) / kDegree, 180 * (j + .5) / 10));
      points.emplace_back(c[0] / c.head<3>().sum(), c[1] / c.head<3>().sum());
    }
  return points;
}

}  // namespace

void skyChromaticity(const Studio& studio) {
  const Points daylight = daylightLocus(), spectral = spectralLocus();
  const std::vector<double> suns = {30, 60, 80, 88, 92, 96};
  Sheet sheet;
  sheet.columnLabels = {"turbidity 2", "turbidity 6", "both, whole diagram"};
  fmt::print(
      "colours of clear skies over the dome\n| model | turbidity | Sun | x | y | mean "
      "distance from the daylight locus | largest |\n|---|---|---|---|---|---|---|\n");
  for (const sky::Model model : {sky::Model::Fast, sky::Model::Preetham}) {
    const std::string name = model == sky::Model::Fast ? "simulation" : "Preetham";
    Plot whole;
    whole.x = {.label = "x", .least = 0, .most = .8, .step = .2};
    whole.y = {.label = name + ": y", .least = 0, .most = .9, .step = .2};
    whole.width = whole.height = 380, whole.legend = false;
    whole.series = {curve("spectrum", 9, spectral, Series::Style::Line, 1.2)};
    std::vector<image::Image> row;
    for (const double turbidity : {2., 6.}) {
      Plot plot;
      plot.x = {.label = "x", .least = .2, .most = .5, .step = .05};
      plot.y = {.label = name + ": y", .least = .2, .most = .5, .step = .05};
      plot.width = plot.height = 380;
      for (std::size_t s = 0; s < suns.size(); ++s) {
        if (model == sky::Model::Preetham && suns[s] > 90) continue;
        sky::SkyOptions options = skyOptions("clear", model, suns[s]);
        options.atmosphere = sky::withTurbidity(options.atmosphere, turbidity);
        const Points colours = coloursOf(skyOf(options));
        double mean = 0, largest = 0;
        Eigen::Vector2d least = Eigen::Vector2d::Ones(), most = Eigen::Vector2d::Zero();
        for (const Eigen::Vector2d& c : colours) {
          const double distance = distanceTo(daylight, c);
          mean += distance / double(colours.size()), largest = std::max(largest, distance);
          least = least.cwiseMin(c), most = most.cwiseMax(c);
        }
        fmt::print(
            "| {} | {:g} | {:g}° | {:.3f} to {:.3f} | {:.3f} to {:.3f} | {:.4f} | {:.4f} |\n", name,
            turbidity, suns[s], least.x(), most.x(), least.y(), most.y(), mean, largest);
        plot.series.push_back(
            curve(fmt::format("Sun at {:g}", suns[s]), 1 + s, colours, Series::Style::Dots, 1.3));
        whole.series.push_back(curve("", 1 + s, colours, Series::Style::Dots, .8));
      }
      plot.series.push_back(curve("daylight", 0, daylight, Series::Style::Line, 1.8));
      plot.series.push_back(curve("", 9, spectral, Series::Style::Line, 1.2));
      row.push_back(draw(plot));
    }
    whole.series.push_back(curve("daylight", 0, daylight, Series::Style::Line, 1.4));
    row.push_back(draw(whole));
    sheet.rows.push_back(std::move(row));
  }
  studio.save(compose(sheet), "sky-chromaticity");
}

void skyCompact(const Studio& studio) {
  using sky::CompactBasis;
  const std::vector<std::pair<CompactBasis, std::string>> bases = {
      {CompactBasis::Cosines, "cosines (Dobashi)"},
      {CompactBasis::HarmonicsAbove, "harmonics, fitted above"},
      {CompactBasis::HarmonicsBlackBelow, "harmonics, black below"},
      {CompactBasis::HarmonicsMirrored, "harmonics, mirrored"}};
  const std::vector<int> sizes = {3, 4, 5, 8, 10};
  Sheet sheet;
  sheet.rows.resize(2);
  fmt::print(
      "luminance off over the dome: rms of the difference over rms luminance / largest over "
      "the same\n| Sun | basis | 9 | 16 | 25 | 64 | 100 |\n|---|---|---|---|---|---|---|\n");
  std::size_t panel = 0;
  for (const double sun : {30., 60., 80., 94.}) {
    const sky::Sky made = skyOf(skyOptions("reference", sky::Model::Fast, sun));
    const sky::SkyColor color = [&](const Vec3d& d) { return made.dome->color(d); };
    Plot plot;
    plot.title = fmt::format("Sun at {:g}", sun);
    plot.x = {.label = "coefficients", .least = 8, .most = 120, .logarithmic = true};
    plot.y = {
        .label = "rms error over rms luminance", .least = .01, .most = 1, .logarithmic = true};
    plot.width = 420, plot.height = 320;
    for (std::size_t b = 0; b < bases.size(); ++b) {
      Points points;
      fmt::print("| {:g}° | {} |", sun, bases[b].second);
      for (const int n : sizes) {
        const sky::CompactSkyError error =
            sky::errorOf(sky::compactSky(bases[b].first, n, color), color);
        points.emplace_back(n * n, error.rms);
        fmt::print(" {:.{}f}% / {:.0f}% |", 100 * error.rms, error.rms < .1 ? 1 : 0,
                   100 * error.largest);
      }
      fmt::print("\n");
      plot.series.push_back(curve(bases[b].second, b + 1, points));
      plot.series.push_back(curve("", b + 1, points, Series::Style::Dots, 2.5));
    }
    sheet.rows[panel++ / 2].push_back(draw(plot));
  }
  studio.save(compose(sheet), "sky-compact");
}

}  // namespace lambent::figures
