#include "lambent/sky/reading.h"

#include <array>
#include <optional>

#include "lambent/sky/make_sky.h"
#include "lambent/sky/sun_coverage.h"
#include "lambent/work/parallel_for.h"

namespace lambent::sky {

namespace {

/// Of a spectrum at the wavelengths of a sky, by trapezia.
double integral(const Sky& sky, std::span<const double> spectrum) {
  double sum = 0;
  for (std::size_t i = 1; i < spectrum.size(); ++i)
    sum += 0.5 * (spectrum[i - 1] + spectrum[i]) * (sky.wavelengths[i] - sky.wavelengths[i - 1]);
  return sum;
}

constexpr double kCentroidOfY = 560;  // nm

std::optional<SunCoverage> discOf(const Sky& sky, const ReadingOptions& options) {
  if (!options.sun) return std::nullopt;
  std::vector<double> exponents{limbDarkening(kCentroidOfY)};
  for (const double nm : options.wavelengths) exponents.push_back(limbDarkening(nm));
  return SunCoverage(sky.sun, sky.horizon, std::move(exponents));
}

}  // namespace

std::vector<Reading> readSky(const Sky& sky, std::span<const Vec3d> directions,
                             const ReadingOptions& options) {
  const std::optional<SunCoverage> disc = discOf(sky, options);
  const std::vector<double>& nm = options.wavelengths;
  std::vector<Reading> readings(directions.size());
  work::parallelFor(readings.size(), [&](std::size_t i) {
    Reading& reading = readings[i];
    reading.luminance = colorSeen(sky, options.below, directions[i])[1];
    reading.radiance.resize(nm.size());
    if (!nm.empty()) spectrumSeen(sky, options.below, directions[i], nm, reading.radiance);
    if (!disc) return;
    std::vector<double> densities(1 + nm.size());
    disc->densities(directions[i], densities);
    reading.luminance += densities[0] * sky.sun.irradiance[1];
    for (std::size_t k = 0; k < nm.size(); ++k)
      reading.radiance[k] += densities[1 + k] * spectrumAt(sky, sky.sun.spectralIrradiance, nm[k]);
  });
  return readings;
}

Brightness brightnessOf(const Sky& sky) {
  const Horizontal horizontal = onHorizontal(sky);
  Brightness bright;
  bright.irradiance = {integral(sky, sky.sun.spectralIrradiance),
                       integral(sky, horizontal.directSpectrum),
                       integral(sky, horizontal.diffuseSpectrum)};
  bright.illuminance = {sky.sun.irradiance[1], horizontal.direct[1], horizontal.diffuse[1]};
  bright.zenithLuminance = sky.dome->color(Vec3d::UnitY())[1];
  return bright;
}

}  // namespace lambent::sky
