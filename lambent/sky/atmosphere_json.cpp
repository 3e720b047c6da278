// Atmosphere → JSON, one key a line. Lengths are in metres: a number of kilometres times 1000 does
// not reach every double.
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "lambent/sky/atmosphere.h"

namespace lambent::sky {
namespace {

/// The fewest digits that come back as the same double; 0 for −0, which is equal to it.
std::string jsonNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value + 0.0) : "null";
}

std::string jsonList(std::span<const double> values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(jsonNumber(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string jsonSpectrum(const Spectral& spectrum, std::string_view values) {
  return fmt::format(R"({{"wavelength_nm": {}, "{}": {}}})", jsonList(spectrum.wavelengths), values,
                     jsonList(spectrum.values));
}

struct ProfileText {
  std::string operator()(const media::DensityProfile::Exponential& law) const {
    return fmt::format(R"({{"scale_height_m": {}}})", jsonNumber(law.scaleHeight));
  }
  std::string operator()(const media::DensityProfile::UsStandard1976&) const {
    return R"("us1976")";
  }
  std::string operator()(const media::DensityProfile::Tabulated& law) const {
    std::vector<double> altitudes, densities;
    for (const auto& point : law.points) {
      altitudes.push_back(point.altitude);
      densities.push_back(point.density);
    }
    return fmt::format(R"({{"altitude_m": {}, "density": {}}})", jsonList(altitudes),
                       jsonList(densities));
  }
};

struct PhaseText {
  std::string operator()(const media::Isotropic&) const { return R"("isotropic")"; }
  std::string operator()(const media::RayleighPhase&) const { return R"("rayleigh")"; }
  std::string operator()(const media::HenyeyGreenstein& p) const {
    return fmt::format(R"({{"henyey_greenstein": {}}})", jsonNumber(p.g));
  }
  std::string operator()(const media::CornetteShanks& p) const {
    return fmt::format(R"({{"cornette_shanks": {}}})", jsonNumber(p.g));
  }
  std::string operator()(const media::DoubleHenyeyGreenstein& p) const {
    return fmt::format(R"({{"double_henyey_greenstein": {}}})",
                       jsonList(std::array{p.f, p.g1, p.g2}));
  }
  std::string operator()(const media::Schlick& p) const {
    return fmt::format(R"({{"schlick": {}}})", jsonNumber(p.k));
  }
};

struct AerosolText {
  std::string operator()(const Atmosphere::Angstrom& law) const {
    return fmt::format(R"("optical_thickness_at_1um": {}, "angstrom_exponent": {})",
                       jsonNumber(law.thicknessAt1um), jsonNumber(law.exponent));
  }
  std::string operator()(const Atmosphere::Junge& law) const {
    return fmt::format(R"("junge": {{"concentration": {}, "exponent": {}}})",
                       jsonNumber(law.concentration), jsonNumber(law.exponent));
  }
};

std::string aerosolText(const Atmosphere& a) {
  if (!a.turbidity) return fmt::format("{{{}}}", std::visit(AerosolText{}, a.aerosols));
  const std::string turbidity = fmt::format(R"("turbidity": {})", jsonNumber(*a.turbidity));
  if (a.aerosols == withTurbidity(a, *a.turbidity).aerosols)
    return fmt::format("{{{}}}", turbidity);
  return fmt::format("{{{}, {}}}", std::visit(AerosolText{}, a.aerosols), turbidity);
}

std::string_view rayleighName(Atmosphere::Rayleigh law) {
  switch (law) {
    case Atmosphere::Rayleigh::Penndorf:
      return "penndorf";
    case Atmosphere::Rayleigh::Formula:
      return "formula";
    case Atmosphere::Rayleigh::Seed:
      return "seed";
  }
  return "";
}

}  // namespace

std::string toJson(const Atmosphere& a) {
  std::string text = "{\n  \"lambent\": \"atmosphere\"";
  const auto add = [&text](std::string_view key, std::string_view value) {
    text += fmt::format(",\n  \"{}\": {}", key, value);
  };
  const auto profile = [](const media::DensityProfile& density) {
    return std::visit(ProfileText{}, density.law());
  };
  add("name",
      nlohmann::json(a.name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  add("planet_radius_m", jsonNumber(a.planetRadius));
  add("top_m", jsonNumber(a.height));
  add("rayleigh", fmt::format("\"{}\"", rayleighName(a.rayleigh)));
  add("air", profile(a.air));
  add("aerosols", aerosolText(a));
  add("single_scattering_albedo", jsonNumber(a.singleScatteringAlbedo));
  add("aerosol_phase", std::visit(PhaseText{}, a.aerosolPhase));
  add("aerosol_profile", profile(a.aerosolProfile));
  add("ozone_dobson", jsonNumber(a.ozone));
  add("ozone_profile", profile(a.ozoneProfile));
  const bool grey = a.groundAlbedo.values.size() == 1 &&
                    a.groundAlbedo == Spectral::constant(a.groundAlbedo.values[0]);
  add("ground_albedo",
      grey ? jsonNumber(a.groundAlbedo.values[0]) : jsonSpectrum(a.groundAlbedo, "value"));
  add("solar_irradiance",
      a.solarIrradiance ? jsonSpectrum(*a.solarIrradiance, "value_w_m2_nm") : R"("astm_g173")");
  return text + "\n}\n";
}

}  // namespace lambent::sky
