// JSON → Atmosphere. Every complaint names the key by its path, "aerosols.turbidity", and its range.
// atmosphere_json.cpp is the way back.
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"
#include "lambent/sky/atmosphere.h"
#include "lambent/sky/medium.h"
#include "lambent/sky/member_reader.h"

namespace lambent::sky {
namespace {

using Json = nlohmann::json;

constexpr const char* kExample =
    R"({"lambent": "atmosphere", "base": "clear", "aerosols": {"turbidity": 3}, "ozone_dobson": 320})";

/// An atmosphere with three tables of a thousand entries is some 60 KB.
constexpr std::uintmax_t kMostFileBytes = 1 << 20;
constexpr std::size_t kLongestName = 200;

constexpr Bounds kRadius = {1e5, 1e9};      // m
constexpr Bounds kTop = {100, 1e6};         // m
constexpr Bounds kScaleHeight = {10, 1e6};  // m
constexpr Bounds kAltitude = {0, 1e6};      // m
constexpr Bounds kFraction = {0, 1};
constexpr Bounds kAsymmetry = {-0.99, 0.99};
constexpr Bounds kWavelength = {100, 10000};  // nm
constexpr Bounds kIrradiance = {0, 1000};     // W m⁻² nm⁻¹
constexpr Bounds kTurbidity = {1, 10};
constexpr double kMostThickness = 20;
/// Smaller densities than this are 0: what is divided by a column must not overflow.
constexpr Bounds kDensity = {1e-9, 1000, true};
constexpr double kLeastColumn = 1e-3;  // m

void readProfile(MemberReader& reader, const Json& json, const std::string& key,
                 media::DensityProfile& into) {
  const Json* value = reader.find(json, key);
  if (!value) return;
  if (!value->is_object()) {
    if (reader.word(*value, key, {"us1976"})) into = media::DensityProfile::usStandard1976();
    return;
  }
  const std::string prefix = key + ".";
  reader.onlyKeys(*value, prefix,
                  {"scale_height_km", "scale_height_m", "altitude_km", "altitude_m", "density"});
  const auto scaleHeight = reader.length(*value, prefix, "scale_height");
  const auto altitude = reader.length(*value, prefix, "altitude");
  const Json* density = reader.find(*value, "density");
  if (scaleHeight.has_value() == (altitude && density) || (altitude.has_value() != !!density))
    return reader.complain(key,
                           "must be \"us1976\" or hold either a scale height or both altitudes and "
                           "densities");
  if (scaleHeight) {
    double metres = 0;
    reader.number(*scaleHeight->value, scaleHeight->path, kScaleHeight, metres,
                  scaleHeight->metres);
    if (reader.sound()) into = media::DensityProfile::exponential(metres);
    return;
  }
  const auto altitudes = reader.list(*altitude->value, altitude->path, kAltitude, altitude->metres);
  const auto densities = reader.list(*density, prefix + "density", kDensity);
  if (altitudes.size() != densities.size())
    return reader.complain(prefix + "density", fmt::format("has {} entries for {} altitudes",
                                                           densities.size(), altitudes.size()));
  std::vector<media::DensityProfile::Point> points;
  for (std::size_t i = 0; i < altitudes.size(); ++i) {
    if (i > 0 && altitudes[i] < altitudes[i - 1])
      return reader.complain(fmt::format("{}[{}]", altitude->path, i),
                             "is below the one before it; altitudes must rise");
    if (i > 1 && altitudes[i] == altitudes[i - 2])
      return reader.complain(fmt::format("{}[{}]", altitude->path, i),
                             "is the third of its altitude; two make a step");
    points.push_back({altitudes[i], densities[i]});
  }
  if (reader.sound()) into = media::DensityProfile::tabulated(std::move(points));
}

/// {"wavelength_nm": […], VALUES: […]}.
Spectral readSpectrum(MemberReader& reader, const Json& value, const std::string& path,
                      std::string_view values, Bounds bounds) {
  reader.onlyKeys(value, path + ".", {"wavelength_nm", values});
  const Json *nm = reader.find(value, "wavelength_nm"), *given = reader.find(value, values);
  if (!nm || !given) {
    reader.complain(path, fmt::format("must hold \"wavelength_nm\" and \"{}\"", values));
    return {};
  }
  Spectral spectrum;
  const std::string nmPath = path + ".wavelength_nm",
                    valuesPath = fmt::format("{}.{}", path, values);
  spectrum.wavelengths = reader.list(*nm, nmPath, kWavelength);
  spectrum.values = reader.list(*given, valuesPath, bounds);
  if (spectrum.wavelengths.size() != spectrum.values.size())
    reader.complain(valuesPath, fmt::format("has {} entries for {} wavelengths",
                                            spectrum.values.size(), spectrum.wavelengths.size()));
  for (std::size_t i = 1; i < spectrum.wavelengths.size(); ++i)
    if (!(spectrum.wavelengths[i] > spectrum.wavelengths[i - 1]))
      reader.complain(fmt::format("{}[{}]", nmPath, i),
                      "is not above the one before it; wavelengths must rise");
  return spectrum;
}

void readPhase(MemberReader& reader, const Json& value, media::PhaseFunction& into) {
  const std::string key = "aerosol_phase";
  if (!value.is_object()) {
    const auto which = reader.word(value, key, {"isotropic", "rayleigh"});
    if (which)
      into = *which == 0 ? media::PhaseFunction(media::Isotropic{})
                         : media::PhaseFunction(media::RayleighPhase{});
    return;
  }
  reader.onlyKeys(value, key + ".",
                  {"henyey_greenstein", "cornette_shanks", "double_henyey_greenstein", "schlick"});
  if (reader.sound() && value.size() != 1)
    return reader.complain(key, "must hold one phase function");
  double asymmetry = 0;
  if (reader.number(value, key + ".", "henyey_greenstein", kAsymmetry, asymmetry))
    into = media::HenyeyGreenstein{asymmetry};
  if (reader.number(value, key + ".", "cornette_shanks", kAsymmetry, asymmetry))
    into = media::CornetteShanks{asymmetry};
  if (reader.number(value, key + ".", "schlick", kAsymmetry, asymmetry))
    into = media::Schlick{asymmetry};
  if (const Json* lobes = reader.find(value, "double_henyey_greenstein")) {
    const std::string path = key + ".double_henyey_greenstein";
    if (!lobes->is_array() || lobes->size() != 3)
      return reader.complain(path,
                             fmt::format("is {}, not a list [f, g1, g2]", quotedJson(*lobes)));
    media::DoubleHenyeyGreenstein phase;
    reader.number((*lobes)[0], path + "[0]", kFraction, phase.f);
    reader.number((*lobes)[1], path + "[1]", kAsymmetry, phase.g1);
    reader.number((*lobes)[2], path + "[2]", kAsymmetry, phase.g2);
    into = phase;
  }
}

/// A turbidity alone makes the aerosols; beside others it is what models by turbidity go by.
void readAerosols(MemberReader& reader, const Json& value, Atmosphere& into) {
  const std::string key = "aerosols";
  if (!value.is_object())
    return reader.complain(key, fmt::format("is {}, not an object {{…}}", quotedJson(value)));
  reader.onlyKeys(value, key + ".",
                  {"turbidity", "optical_thickness_at_1um", "angstrom_exponent", "junge"});
  if (reader.sound() && value.empty())
    return reader.complain(key,
                           "is empty; it says a turbidity, an optical thickness or Junge's law");
  std::optional<double> turbidity;
  if (double given = 0; reader.number(value, key + ".", "turbidity", kTurbidity, given))
    turbidity = given;
  if (turbidity && value.size() == 1 && reader.sound()) {
    into = withTurbidity(std::move(into), *turbidity);
    return;
  }
  const Json* junge = reader.find(value, "junge");
  if (junge && value.size() > (turbidity ? 2u : 1u))
    return reader.complain(key, "must go by an optical thickness or by Junge's law, not by both");
  into.turbidity = turbidity;
  if (!junge) {
    const auto* base = std::get_if<Atmosphere::Angstrom>(&into.aerosols);
    Atmosphere::Angstrom law = base ? *base : Atmosphere::Angstrom{};
    reader.number(value, key + ".", "optical_thickness_at_1um", {0, kMostThickness},
                  law.thicknessAt1um);
    reader.number(value, key + ".", "angstrom_exponent", {-2, 4}, law.exponent);
    into.aerosols = law;
    return;
  }
  if (!junge->is_object())
    return reader.complain(key + ".junge",
                           fmt::format("is {}, not an object {{…}}", quotedJson(*junge)));
  Atmosphere::Junge law;
  reader.onlyKeys(*junge, key + ".junge.", {"concentration", "exponent"});
  reader.number(*junge, key + ".junge.", "concentration", {0, 1}, law.concentration);
  reader.number(*junge, key + ".junge.", "exponent", {2, 6}, law.exponent);
  into.aerosols = law;
}

/// What is to be spread over a profile needs one that is not empty.
void checkColumns(MemberReader& reader, const Atmosphere& a) {
  if (!reader.sound()) return;
  constexpr std::array<double, 1> kGreen = {550};
  const auto* angstrom = std::get_if<Atmosphere::Angstrom>(&a.aerosols);
  const double column = a.aerosolProfile.column(a.height);
  if (!(angstrom && angstrom->thicknessAt1um == 0) && !(column >= kLeastColumn))
    return reader.complain("aerosol_profile",
                           fmt::format("has next to no density below the top ({} km): the aerosols "
                                       "have no place",
                                       a.height / 1000));
  if (a.ozone > 0 && !(a.ozoneProfile.column(a.height) >= kLeastColumn))
    return reader.complain("ozone_profile",
                           fmt::format("has next to no density below the top ({} km): the ozone "
                                       "has no place",
                                       a.height / 1000));
  if (angstrom) return;
  const double thickness = mediumOf(a, kGreen).extinction[kAerosol][0] * column;
  if (!(thickness <= kMostThickness))
    reader.complain("aerosols.junge",
                    fmt::format("comes to an optical thickness of {:.3g} at 550 nm; it must be {} "
                                "at most",
                                thickness, kMostThickness));
}

Atmosphere readKeys(MemberReader& reader, const Json& json) {
  reader.onlyKeys(
      json, "",
      {"lambent", "name", "comment", "base", "planet_radius_km", "planet_radius_m", "top_km",
       "top_m", "rayleigh", "air", "aerosols", "single_scattering_albedo", "aerosol_phase",
       "aerosol_profile", "ozone_dobson", "ozone_profile", "ground_albedo", "solar_irradiance"},
      {"aerosols.turbidity", "aerosols.optical_thickness_at_1um", "aerosols.angstrom_exponent",
       "aerosols.junge"});
  std::string base = "clear";
  if (const Json* value = reader.find(json, "base")) {
    if (value->is_string()) base = value->get<std::string>();
    if (!value->is_string() || !preset(base))
      reader.complain("base", fmt::format("is {}; {}", quotedJson(*value),
                                          hint(value->is_string() ? base : "",
                                               {presets().begin(), presets().end()})));
  }
  if (!reader.sound()) return {};
  Atmosphere a = *preset(base);
  if (const Json* value = reader.find(json, "name")) {
    if (!value->is_string() || value->get_ref<const std::string&>().size() > kLongestName)
      reader.complain("name", fmt::format("is {}, not a text of at most {} bytes",
                                          quotedJson(*value), kLongestName));
    else
      a.name = value->get<std::string>();
  }
  reader.length(json, "planet_radius", kRadius, a.planetRadius);
  reader.length(json, "top", kTop, a.height);
  if (const Json* value = reader.find(json, "rayleigh"))
    if (const auto law = reader.word(*value, "rayleigh", {"penndorf", "formula", "seed"}))
      a.rayleigh = Atmosphere::Rayleigh(*law);
  readProfile(reader, json, "air", a.air);
  if (const Json* value = reader.find(json, "aerosols")) readAerosols(reader, *value, a);
  reader.number(json, "", "single_scattering_albedo", kFraction, a.singleScatteringAlbedo);
  if (const Json* value = reader.find(json, "aerosol_phase"))
    readPhase(reader, *value, a.aerosolPhase);
  readProfile(reader, json, "aerosol_profile", a.aerosolProfile);
  reader.number(json, "", "ozone_dobson", {0, 2000}, a.ozone);
  readProfile(reader, json, "ozone_profile", a.ozoneProfile);
  if (const Json* value = reader.find(json, "ground_albedo")) {
    if (value->is_object()) {
      a.groundAlbedo = readSpectrum(reader, *value, "ground_albedo", "value", kFraction);
    } else {
      double grey = 0;
      reader.number(*value, "ground_albedo", kFraction, grey);
      a.groundAlbedo = Spectral::constant(grey);
    }
  }
  if (const Json* value = reader.find(json, "solar_irradiance")) {
    if (value->is_object())
      a.solarIrradiance =
          readSpectrum(reader, *value, "solar_irradiance", "value_w_m2_nm", kIrradiance);
    else if (reader.word(*value, "solar_irradiance", {"astm_g173"}))
      a.solarIrradiance.reset();
  }
  checkColumns(reader, a);
  return a;
}

}  // namespace

Result<Atmosphere> parseAtmosphere(std::string_view text, const std::string& name) {
  const auto wrong = [&name](const std::string& what) {
    return report::badInput(fmt::format("{}: {}", name, what));
  };
  if (text.size() > kMostFileBytes)
    return wrong(fmt::format("{} bytes are too many for an atmosphere", text.size()));
  const Result<Json> json = file::parseJson(text);
  if (!json)
    return wrong(
        fmt::format("not JSON ({}). An atmosphere looks like {}", json.error().message, kExample));
  const auto kind = json->is_object() ? json->find("lambent") : json->end();
  if (!json->is_object() || kind == json->end() || *kind != "atmosphere")
    return wrong(
        fmt::format("JSON, but not an atmosphere: \"lambent\": \"atmosphere\" is missing. "
                    "An atmosphere looks like {}",
                    kExample));
  if (const auto key = file::repeatedKey(text))
    return wrong(fmt::format("{} stands twice in one object", quotedJson(*key)));
  MemberReader reader(name, "an atmosphere");
  Atmosphere atmosphere = readKeys(reader, *json);
  if (!reader.sound()) return reader.error();
  return atmosphere;
}

Result<Atmosphere> readAtmosphere(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kMostFileBytes)
    return report::badInput(
        fmt::format("{}: {} bytes are too many for an atmosphere", path.string(), size));
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return parseAtmosphere({reinterpret_cast<const char*>(bytes->data()), bytes->size()},
                         path.string());
}

}  // namespace lambent::sky
