// This work is based on:
// - preetham1999practical: appendix 1, aerosols by turbidity.
#include "lambent/sky/atmosphere.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "lambent/radiometry/spectra.h"

namespace lambent::sky {
namespace {

constexpr std::array<std::string_view, 5> kPresets = {"clear", "reference", "standard", "hazy",
                                                      "pure"};

/// The Sun of published comparisons at every 5 nm.
Spectral comparisonSun() {
  Spectral sun;
  for (double nm = 340; nm <= 740; nm += 5) {
    sun.wavelengths.push_back(nm);
    sun.values.push_back(radiometry::solarIrradianceOfComparisons(nm));
  }
  return sun;
}

}  // namespace

double Spectral::at(double nanometres) const {
  assert(!values.empty() && values.size() == wavelengths.size());
  const auto above = std::upper_bound(wavelengths.begin(), wavelengths.end(), nanometres);
  if (above == wavelengths.begin()) return values.front();
  if (above == wavelengths.end()) return values.back();
  const std::size_t i = std::size_t(above - wavelengths.begin());
  const double t = (nanometres - wavelengths[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
  return (1 - t) * values[i - 1] + t * values[i];
}

double solarIrradianceOf(const Atmosphere& atmosphere, double nanometres) {
  return atmosphere.solarIrradiance ? atmosphere.solarIrradiance->at(nanometres)
                                    : radiometry::solarIrradiance(nanometres);
}

Atmosphere withTurbidity(Atmosphere atmosphere, double turbidity) {
  atmosphere.aerosols = Atmosphere::Angstrom{std::max(0.0, 0.04608 * turbidity - 0.04586), 1.3};
  atmosphere.turbidity = turbidity;
  return atmosphere;
}

std::span<const std::string_view> presets() {
  return kPresets;
}

std::optional<Atmosphere> preset(std::string_view name) {
  Atmosphere a;
  a.name = name;
  if (name == "clear") return withTurbidity(a, 2.5);
  if (name == "hazy") {
    a.singleScatteringAlbedo = 0.92;
    return withTurbidity(a, 6);
  }
  if (name == "pure") {  // air alone
    a.aerosols = Atmosphere::Angstrom{0, 1.3};
    a.ozone = 0;
    return a;
  }
  if (name == "standard") {
    a.air = media::DensityProfile::usStandard1976();
    return withTurbidity(a, 2.5);
  }
  if (name == "reference") {
    // The atmosphere of published tables of sky radiance: no ozone.
    a.height = 6e4;
    a.aerosols = Atmosphere::Angstrom{0.04, 0.8};
    a.singleScatteringAlbedo = 0.8;
    a.aerosolPhase = media::CornetteShanks{0.7};
    a.ozone = 0;
    a.groundAlbedo = {{450, 550, 650, 720}, {0.031, 0.089, 0.042, 0.234}};
    a.solarIrradiance = comparisonSun();
    return a;
  }
  return std::nullopt;
}

}  // namespace lambent::sky
