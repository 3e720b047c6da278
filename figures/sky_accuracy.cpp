// The fast sky beside the exact one over the dome, and both beside the published table.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "figures/sky.h"
#include "figures/sky_published.h"

namespace lambent::figures {
namespace {

constexpr std::size_t kNumbers = kPublishedWavelengths.size();

/// Relative errors: root mean square, and the one that is farthest from 0.
struct Errors {
  double squares = 0, largest = 0;
  int count = 0;
  void add(double error) {
    squares += error * error, ++count;
    if (std::abs(error) > std::abs(largest)) largest = error;
  }
  double rms() const { return std::sqrt(squares / std::max(count, 1)); }
};

std::array<double, kNumbers> spectrumOf(const sky::Sky& sky, const Vec3d& direction) {
  std::array<double, kNumbers> out{};
  sky.dome->spectrum(direction, kPublishedWavelengths, out);
  return out;
}

/// Over directions of equal solid angle, from 1.6° above the horizon up.
void fastAgainstExact(const std::vector<double>& suns) {
  fmt::print("fast against exact, percent\nsun zenith");
  for (const double nm : kPublishedWavelengths) fmt::print(",{:g} rms,{:g} largest", nm, nm);
  fmt::print(",luminance rms,luminance largest,seconds of exact\n");
  for (const double sun : suns) {
    const sky::Sky fast = skyOf(skyOptions("reference", sky::Model::Fast, sun));
    const auto start = std::chrono::steady_clock::now();
    const sky::Sky exact = skyOf(skyOptions("reference", sky::Model::Exact, sun));
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::array<Errors, kNumbers + 1> errors;
    constexpr int kElevations = 18, kAzimuths = 13;
    for (int i = 0; i < kElevations; ++i)
      for (int j = 0; j < kAzimuths; ++j) {
        const Vec3d direction =
            skyDirection(std::acos((i + .5) / kElevations) / kDegree, 180.0 * (j + .5) / kAzimuths);
        const auto a = spectrumOf(fast, direction), b = spectrumOf(exact, direction);
        for (std::size_t k = 0; k < kNumbers; ++k) errors[k].add(a[k] / b[k] - 1);
        errors[kNumbers].add(fast.dome->color(direction)[1] / exact.dome->color(direction)[1] - 1);
      }
    fmt::print("{:g}", sun);
    for (const Errors& e : errors) fmt::print(",{:.3f},{:+.3f}", 100 * e.rms(), 100 * e.largest);
    fmt::print(",{:.0f}\n", seconds);
    std::fflush(stdout);
  }
}

void againstPublished(sky::Model model, const std::string& name) {
  fmt::print(
      "\n{} against the published table, percent (in standard errors of the table)\n| Sun | "
      "view, azimuth |",
      name);
  for (const double nm : kPublishedWavelengths) fmt::print(" {:g} nm |", nm);
  fmt::print("\n|---|---|---|---|---|---|\n");
  std::array<std::array<Errors, kNumbers + 1>, 2> errors;  // by day and in twilight; the last: all
  int within = 0, all = 0;
  for (const PublishedRadiance& row : kPublishedRadiances) {
    const sky::Sky sky = skyOf(skyOptions("reference", model, row.sunZenith));
    const auto radiance = spectrumOf(sky, skyDirection(row.viewZenith, row.azimuth));
    fmt::print("| {:g}° | {:g}°, {:g}° |", row.sunZenith, row.viewZenith, row.azimuth);
    for (std::size_t k = 0; k < kNumbers; ++k) {
      const double error = radiance[k] / row.radiance[k] - 1;
      const double allowed = .002 + 3 * row.standardError[k] / 100;
      auto& of = errors[row.sunZenith > 90];
      of[k].add(error), of[kNumbers].add(error);
      ++all, within += std::abs(error) <= allowed;
      fmt::print(" {:+.2f} ({:+.1f}) |", 100 * error, 100 * error / row.standardError[k]);
    }
    fmt::print("\n");
  }
  for (const int twilight : {0, 1}) {
    fmt::print("{}: rms / largest", twilight ? "Sun at 94°" : "Sun at 60°");
    for (const Errors& e : errors[std::size_t(twilight)])
      fmt::print(", {:.2f}% / {:+.2f}%", 100 * e.rms(), 100 * e.largest);
    fmt::print(" (the last: all)\n");
  }
  fmt::print("within three standard errors and .2%: {} of {}\n", within, all);
}

}  // namespace

void skyAccuracy(const Studio& studio) {
  againstPublished(sky::Model::Fast, "fast");
  if (studio.quick) return;
  againstPublished(sky::Model::Exact, "exact");
  fmt::print("\n");
  fastAgainstExact(studio.suns);
}

}  // namespace lambent::figures
