// An atmosphere as JSON (docs/atmospheres.md): what a file does not say is as the preset has it that
// it is based on.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lambent/file/atomic_file.h"
#include "lambent/file/json.h"
#include "lambent/sky/atmosphere.h"

namespace lambent::sky {
using nlohmann::json;
using report::badInput;

namespace {

/// An atmosphere is some kilobytes; what is much larger is some other file.
constexpr std::uintmax_t kMostAtmosphereBytes = 1 << 20;
constexpr std::size_t kMostPoints = 10000;

/// What went wrong at a key, or nothing.
using Problem = std::optional<std::string>;

std::string shownValue(const json& value) {
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

Problem readNumber(const json& value, double low, double high, double& out,
                   std::string_view unit = "") {
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (!(number >= low && number <= high))
    return fmt::format("is {}, and must be a number from {} to {}{}", shownValue(value), low, high,
                       unit);
  out = number;
  return {};
}

/// The only member of {"name": value}, or a name alone.
struct Named {
  std::string name;
  json value;
};
std::optional<Named> namedOf(const json& value) {
  if (value.is_string()) return Named{value.get<std::string>(), json()};
  if (value.is_object() && value.size() == 1)
    return Named{value.begin().key(), value.begin().value()};
  return std::nullopt;
}

/// Members of an object, all of them known and there.
Problem readMembers(
    const json& value,
    std::initializer_list<std::pair<const char*, std::function<Problem(const json&)>>> members) {
  std::string names;
  for (const auto& [name, read] : members)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  if (!value.is_object() || value.size() != members.size())
    return fmt::format("is {}, and must have {}", shownValue(value), names);
  for (const auto& [name, read] : members) {
    if (!value.contains(name)) return fmt::format("lacks \"{}\"", name);
    if (const Problem problem = read(value[name])) return fmt::format("\"{}\" {}", name, *problem);
  }
  return {};
}

Problem readProfile(const json& value, media::DensityProfile& out) {
  const auto named = namedOf(value);
  if (named && named->name == "us-standard-1976" && named->value.is_null()) {
    out = media::DensityProfile::usStandard1976();
    return {};
  }
  if (named && named->name == "exponential") {
    double scaleHeight = 0;
    if (const Problem p = readNumber(named->value, 1, 1e6, scaleHeight, " m")) return p;
    out = media::DensityProfile::exponential(scaleHeight);
    return {};
  }
  if (named && named->name == "points" && named->value.is_array()) {
    std::vector<media::DensityProfile::Point> points;
    if (named->value.empty() || named->value.size() > kMostPoints)
      return fmt::format("has {} points, and must have 1 to {}", named->value.size(), kMostPoints);
    for (const json& each : named->value) {
      media::DensityProfile::Point point{};
      if (!each.is_array() || each.size() != 2)
        return fmt::format("has the point {}, and points are [altitude in m, density]",
                           shownValue(each));
      if (const Problem p = readNumber(each[0], 0, 1e6, point.altitude, " m")) return p;
      if (const Problem p = readNumber(each[1], 0, 1e6, point.density)) return p;
      if (!points.empty() && point.altitude < points.back().altitude)
        return fmt::format("has points whose altitude falls from {} to {} m",
                           points.back().altitude, point.altitude);
      points.push_back(point);
    }
    out = media::DensityProfile::tabulated(std::move(points));
    return {};
  }
  return fmt::format(
      "is {}, and must be {{\"exponential\": METRES}}, \"us-standard-1976\" or {{\"points\": "
      "[[METRES, DENSITY], …]}}",
      shownValue(value));
}

Problem readPhase(const json& value, media::PhaseFunction& out) {
  constexpr double kMost = 0.99;
  const auto named = namedOf(value);
  if (named && named->value.is_null()) {
    if (named->name == "isotropic") return out = media::Isotropic{}, Problem();
    if (named->name == "rayleigh") return out = media::RayleighPhase{}, Problem();
  }
  double g = 0;
  const auto one = [&] { return readNumber(named->value, -kMost, kMost, g); };
  if (named && named->name == "henyey-greenstein") {
    if (const Problem p = one()) return p;
    return out = media::HenyeyGreenstein{g}, Problem();
  }
  if (named && named->name == "cornette-shanks") {
    if (const Problem p = one()) return p;
    return out = media::CornetteShanks{g}, Problem();
  }
  if (named && named->name == "schlick") {
    if (const Problem p = one()) return p;
    return out = media::Schlick{g}, Problem();
  }
  if (named && named->name == "double-henyey-greenstein") {
    media::DoubleHenyeyGreenstein two;
    const Problem p =
        readMembers(named->value,
                    {{"f", [&](const json& v) { return readNumber(v, 0, 1, two.f); }},
                     {"g1", [&](const json& v) { return readNumber(v, -kMost, kMost, two.g1); }},
                     {"g2", [&](const json& v) { return readNumber(v, -kMost, kMost, two.g2); }}});
    if (!p) out = two;
    return p;
  }
  return fmt::format(
      "is {}, and must be \"isotropic\", \"rayleigh\", {{\"henyey-greenstein\": G}}, "
      "{{\"cornette-shanks\": G}}, {{\"schlick\": K}} or {{\"double-henyey-greenstein\": {{\"f\": "
      "F, "
      "\"g1\": G, \"g2\": G}}}}",
      shownValue(value));
}

Problem readSpectral(const json& value, double high, Spectral& out) {
  if (value.is_number()) {
    double grey = 0;
    if (const Problem p = readNumber(value, 0, high, grey)) return p;
    out = Spectral::constant(grey);
    return {};
  }
  Spectral spectral;
  const auto list = [](std::vector<double>& into, double low, double most) {
    return [&into, low, most](const json& v) -> Problem {
      if (!v.is_array() || v.empty() || v.size() > kMostPoints)
        return fmt::format("must be a list of 1 to {} numbers", kMostPoints);
      for (const json& each : v)
        if (const Problem p = readNumber(each, low, most, into.emplace_back())) return p;
      return {};
    };
  };
  if (const Problem p = readMembers(value, {{"wavelengths", list(spectral.wavelengths, 100, 1e5)},
                                            {"values", list(spectral.values, 0, high)}}))
    return value.is_object() ? p : fmt::format("{}, or be a number", *p);
  if (spectral.values.size() != spectral.wavelengths.size())
    return fmt::format("has {} wavelengths and {} values", spectral.wavelengths.size(),
                       spectral.values.size());
  for (std::size_t i = 1; i < spectral.wavelengths.size(); ++i)
    if (!(spectral.wavelengths[i] > spectral.wavelengths[i - 1]))
      return fmt::format("has wavelengths that do not rise: {} after {}", spectral.wavelengths[i],
                         spectral.wavelengths[i - 1]);
  out = std::move(spectral);
  return {};
}

Problem readAerosols(const json& value, Atmosphere& out) {
  const auto named = namedOf(value);
  if (named && named->name == "turbidity") {
    double turbidity = 0;
    if (const Problem p = readNumber(named->value, 1, 10, turbidity)) return p;
    out = withTurbidity(std::move(out), turbidity);
    return {};
  }
  if (named && named->name == "angstrom") {
    Atmosphere::Angstrom law;
    const Problem p = readMembers(
        named->value,
        {{"thickness-at-1um",
          [&](const json& v) { return readNumber(v, 0, 10, law.thicknessAt1um); }},
         {"exponent", [&](const json& v) { return readNumber(v, -1, 4, law.exponent); }}});
    if (p) return p;
    out.aerosols = law;
  } else if (named && named->name == "junge") {
    Atmosphere::Junge law;
    const Problem p = readMembers(
        named->value,
        {{"concentration",
          [&](const json& v) { return readNumber(v, 0, 1e-14, law.concentration); }},
         {"exponent", [&](const json& v) { return readNumber(v, 2, 6, law.exponent); }}});
    if (p) return p;
    out.aerosols = law;
  } else {
    return fmt::format(
        "is {}, and must be {{\"turbidity\": T}}, {{\"angstrom\": {{\"thickness-at-1um\": B, "
        "\"exponent\": A}}}} or {{\"junge\": {{\"concentration\": C, \"exponent\": V}}}}",
        shownValue(value));
  }
  out.turbidity.reset();
  return {};
}

Problem readRayleigh(const json& value, Atmosphere::Rayleigh& out) {
  if (value == "penndorf") return out = Atmosphere::Rayleigh::Penndorf, Problem();
  if (value == "formula") return out = Atmosphere::Rayleigh::Formula, Problem();
  if (value == "seed") return out = Atmosphere::Rayleigh::Seed, Problem();
  return fmt::format("is {}, and must be \"penndorf\", \"formula\" or \"seed\"", shownValue(value));
}

struct FileKey {
  const char* name;
  Problem (*read)(const json&, Atmosphere&);
};
constexpr FileKey kFileKeys[] = {
    {"planet-radius",
     [](const json& v, Atmosphere& a) { return readNumber(v, 1e5, 1e9, a.planetRadius, " m"); }},
    {"height",
     [](const json& v, Atmosphere& a) { return readNumber(v, 1e3, 1e6, a.height, " m"); }},
    {"rayleigh", [](const json& v, Atmosphere& a) { return readRayleigh(v, a.rayleigh); }},
    {"air", [](const json& v, Atmosphere& a) { return readProfile(v, a.air); }},
    {"aerosols", readAerosols},
    {"single-scattering-albedo",
     [](const json& v, Atmosphere& a) { return readNumber(v, 0, 1, a.singleScatteringAlbedo); }},
    {"aerosol-phase", [](const json& v, Atmosphere& a) { return readPhase(v, a.aerosolPhase); }},
    {"aerosol-profile",
     [](const json& v, Atmosphere& a) { return readProfile(v, a.aerosolProfile); }},
    {"ozone", [](const json& v, Atmosphere& a) { return readNumber(v, 0, 1000, a.ozone, " DU"); }},
    {"ozone-profile", [](const json& v, Atmosphere& a) { return readProfile(v, a.ozoneProfile); }},
    {"ground-albedo",
     [](const json& v, Atmosphere& a) { return readSpectral(v, 1, a.groundAlbedo); }},
    {"solar-irradiance",
     [](const json& v, Atmosphere& a) {
       return readSpectral(v, 100, a.solarIrradiance.emplace());
     }},
};

json toJsonValue(const Spectral& spectral) {
  if (spectral.values.size() == 1) return spectral.values[0];
  return {{"wavelengths", spectral.wavelengths}, {"values", spectral.values}};
}

json toJsonValue(const media::DensityProfile& profile) {
  const auto& law = profile.law();
  if (const auto* e = std::get_if<media::DensityProfile::Exponential>(&law))
    return {{"exponential", e->scaleHeight}};
  if (std::holds_alternative<media::DensityProfile::UsStandard1976>(law)) return "us-standard-1976";
  json points = json::array();
  for (const auto& point : std::get<media::DensityProfile::Tabulated>(law).points)
    points.push_back(json::array({point.altitude, point.density}));
  return {{"points", std::move(points)}};
}

struct PhaseToJson {
  json operator()(const media::Isotropic&) const { return "isotropic"; }
  json operator()(const media::RayleighPhase&) const { return "rayleigh"; }
  json operator()(const media::HenyeyGreenstein& p) const { return {{"henyey-greenstein", p.g}}; }
  json operator()(const media::CornetteShanks& p) const { return {{"cornette-shanks", p.g}}; }
  json operator()(const media::Schlick& p) const { return {{"schlick", p.k}}; }
  json operator()(const media::DoubleHenyeyGreenstein& p) const {
    return {{"double-henyey-greenstein", {{"f", p.f}, {"g1", p.g1}, {"g2", p.g2}}}};
  }
};

json aerosolsToJson(const Atmosphere& a) {
  if (a.turbidity) return {{"turbidity", *a.turbidity}};
  if (const auto* law = std::get_if<Atmosphere::Angstrom>(&a.aerosols))
    return {{"angstrom", {{"thickness-at-1um", law->thicknessAt1um}, {"exponent", law->exponent}}}};
  const auto& law = std::get<Atmosphere::Junge>(a.aerosols);
  return {{"junge", {{"concentration", law.concentration}, {"exponent", law.exponent}}}};
}

}  // namespace

Result<Atmosphere> parseAtmosphere(std::string_view text, const std::string& name) {
  const auto wrong = [&](const std::string& what) {
    return badInput(fmt::format("{}: {}", name, what));
  };
  const Result<json> parsed = file::parseJson(text);
  if (!parsed) return wrong(fmt::format("not JSON ({})", parsed.error().message));
  const json& root = *parsed;
  if (!root.is_object() || !root.contains("lambent") || root["lambent"] != "atmosphere")
    return wrong(
        "JSON, but not an atmosphere: \"lambent\": \"atmosphere\" is missing. One looks like "
        "{\"lambent\": \"atmosphere\", \"base\": \"clear\", \"aerosols\": {\"turbidity\": 3}}");
  Atmosphere atmosphere = *preset("clear");
  if (root.contains("base")) {
    const auto base = root["base"].is_string() ? preset(root["base"].get<std::string>())
                                               : std::optional<Atmosphere>();
    std::string names;
    for (const std::string_view each : presets())
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", each);
    if (!base)
      return wrong(
          fmt::format("\"base\" is {}, and must be one of {}", shownValue(root["base"]), names));
    atmosphere = *base;
  }
  atmosphere.name = name;
  if (root.contains("name")) {
    if (!root["name"].is_string()) return wrong("\"name\" must be a text");
    atmosphere.name = root["name"].get<std::string>();
  }
  for (const auto& [key, value] : root.items()) {
    if (key == "lambent" || key == "base" || key == "name") continue;
    const auto known = std::find_if(std::begin(kFileKeys), std::end(kFileKeys),
                                    [&k = key](const FileKey& each) { return k == each.name; });
    if (known == std::end(kFileKeys)) {
      std::string names;
      for (const FileKey& each : kFileKeys) names += fmt::format(", {}", each.name);
      return wrong(
          fmt::format("there is no key \"{:.40}\"; the keys are name, base{}", key, names));
    }
    if (const Problem problem = known->read(value, atmosphere))
      return wrong(fmt::format("\"{}\" {}", key, *problem));
  }
  return atmosphere;
}

Result<Atmosphere> readAtmosphere(const std::filesystem::path& path) {
  std::error_code sizeError;
  const std::uintmax_t size = std::filesystem::file_size(path, sizeError);
  if (!sizeError && size > kMostAtmosphereBytes)
    return badInput(fmt::format("{}: {} bytes are too many for an atmosphere, which is at most {}",
                                path.string(), size, kMostAtmosphereBytes));
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return parseAtmosphere({reinterpret_cast<const char*>(bytes->data()), bytes->size()},
                         path.string());
}

std::string toJson(const Atmosphere& a) {
  constexpr std::array<const char*, 3> kRayleigh = {"penndorf", "formula", "seed"};
  json root = {{"lambent", "atmosphere"},
               {"name", a.name},
               {"planet-radius", a.planetRadius},
               {"height", a.height},
               {"rayleigh", kRayleigh[std::size_t(a.rayleigh)]},
               {"air", toJsonValue(a.air)},
               {"aerosols", aerosolsToJson(a)},
               {"single-scattering-albedo", a.singleScatteringAlbedo},
               {"aerosol-phase", std::visit(PhaseToJson(), a.aerosolPhase)},
               {"aerosol-profile", toJsonValue(a.aerosolProfile)},
               {"ozone", a.ozone},
               {"ozone-profile", toJsonValue(a.ozoneProfile)},
               {"ground-albedo", toJsonValue(a.groundAlbedo)}};
  if (a.solarIrradiance) root["solar-irradiance"] = toJsonValue(*a.solarIrradiance);
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace lambent::sky
