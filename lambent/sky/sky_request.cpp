// The table of keys, and from what they say to where the Sun stands.
#include "lambent/sky/sky_request.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"
#include "lambent/astronomy/refraction.h"
#include "lambent/astronomy/sun.h"
#include "lambent/sky/member_reader.h"

namespace lambent::sky {
using report::badUsage;

namespace {

constexpr double kRadians = kPi / 180;
/// End of astronomical twilight, degrees.
constexpr double kNight = -18;
constexpr double kMostAltitude = 100000;  // m; an atmosphere says its own
constexpr std::string_view kModels =
    "exact, fast, preetham, perez, asrc-cie, cie-overcast, cie-clear, and cie:1 … cie:15";

/// Finite. A sign of either kind may stand before it.
std::optional<double> numberOf(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

struct Range {
  double low, high;
  std::string_view unit;  ///< " degrees", or nothing
};

template <class Number>
Status setNumber(Number& out, std::string_view text, const Range& range,
                 std::string_view outside = {}) {
  const std::optional<double> value = numberOf(text);
  if (!value)
    return badUsage(fmt::format("'{}' is not a number; it takes {} to {}{}", text, range.low,
                                range.high, range.unit));
  if (*value < range.low || *value > range.high)
    return badUsage(fmt::format("{} is not within {} to {}{}{}", text, range.low, range.high,
                                range.unit, outside));
  out = *value;
  return Status::ok();
}

/// Hours, or hours and minutes: 2, +5.5, -03:30.
Status setUtcOffset(SkyRequest& request, std::string_view text) {
  const Range range{-14, 14, " hours east of UTC"};
  const std::size_t colon = text.find(':');
  if (colon == text.npos) return setNumber(request.utcOffset, text, range);
  const std::optional<double> hours = numberOf(text.substr(0, colon));
  const std::optional<double> minutes = numberOf(text.substr(colon + 1));
  const bool sound = hours && minutes && text.size() == colon + 3 && *hours == std::trunc(*hours) &&
                     *minutes == std::trunc(*minutes) && *minutes >= 0 && *minutes < 60;
  if (!sound)
    return badUsage(
        fmt::format("'{}' is no offset from UTC: write hours, as 2 or -3.5, or hours "
                    "and minutes, as +05:30",
                    text));
  const double sign = text.find('-') < colon ? -1 : 1;
  return setNumber(request.utcOffset, fmt::format("{}", *hours + sign * *minutes / 60), range);
}

Status setModel(SkyRequest& request, std::string_view text) {
  constexpr std::pair<std::string_view, Model> kNames[] = {
      {"exact", Model::Exact},       {"fast", Model::Fast},
      {"preetham", Model::Preetham}, {"perez", Model::Perez},
      {"asrc-cie", Model::AsrcCie},  {"cie-overcast", Model::CieOvercast},
      {"cie-clear", Model::CieClear}};
  for (const auto& [name, model] : kNames)
    if (text == name) {
      request.model = model;
      return Status::ok();
    }
  if (!text.starts_with("cie:"))
    return badUsage(fmt::format("'{}' is no model; there are {}", text, kModels));
  const std::optional<double> type = numberOf(text.substr(4));
  if (!type || *type != std::trunc(*type) || *type < 1 || *type > 15)
    return badUsage(fmt::format("'{}': CIE's standard skies are cie:1 to cie:15", text));
  request.model = Model::CieGeneral;
  request.cieType = int(*type);
  return Status::ok();
}

Status setAltitude(SkyRequest& request, std::string_view text) {
  const std::optional<double> value = numberOf(text);
  const bool under = value && *value < 0;
  return setNumber(request.altitude, text, {0, kMostAltitude, " metres above the ground"},
                   under ? ": that is under the ground" : ": that is in space");
}

Status setRefine(SkyRequest& request, std::string_view text) {
  double steps = 0;
  if (const Status status = setNumber(steps, text, {0, 3, ""}); !status) return status;
  if (steps != std::trunc(steps)) return badUsage(fmt::format("'{}' is no whole number", text));
  request.refine = int(steps);
  return Status::ok();
}

constexpr RequestKey kKeys[] = {
    {"date", "YYYY-MM-DD", "Day of the civil clock, 1600 to 2400", "Moment",
     [](SkyRequest& r, std::string_view v) -> Status {
       if (const auto moment = astronomy::parseMoment(v, "12:00", 0); !moment)
         return moment.error();
       r.date = v;
       return Status::ok();
     }},
    {"time", "HH:MM[:SS]", "What that clock shows, 00:00 to 23:59:59", "Moment",
     [](SkyRequest& r, std::string_view v) -> Status {
       if (const auto moment = astronomy::parseMoment("2000-06-01", v, 0); !moment)
         return moment.error();
       r.time = v;
       return Status::ok();
     }},
    {"utc-offset", "HOURS", "How far the clock is ahead of UTC, as 2, -3.5 or +05:30 (default: 0)",
     "Moment", setUtcOffset},
    {"lat", "DEGREES", "Latitude, north positive", "Moment",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.latitude, v, {-90, 90, " degrees, north positive"});
     }},
    {"lon", "DEGREES", "Longitude, east positive", "Moment",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.longitude, v, {-180, 180, " degrees, east positive"});
     }},
    {"sun-elevation", "DEGREES", "Instead of moment and place: how high the Sun is seen, -18 to 90",
     "Sun",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.sunElevation, v, {-90, 90, " degrees"});
     }},
    {"sun-azimuth", "DEGREES", "Its compass bearing: north 0, east 90 (default: 180, in the south)",
     "Sun",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.sunAzimuth, v, {-360, 360, " degrees"});
     }},
    {"model", "NAME",
     "exact, fast, preetham, perez, asrc-cie, cie-overcast, cie-clear, cie:1 to cie:15 "
     "(default: fast)",
     "Model", setModel},
    {"turbidity", "T", "How hazy the air is, 1 (none) to 10", "Air",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.turbidity, v, {1, 10, ""});
     }},
    {"albedo", "A", "How much light the ground sends back, 0 to 1", "Air",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.albedo, v, {0, 1, ""});
     }},
    {"ozone", "DU", "Column of ozone, Dobson units, 0 to 1000", "Air",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.ozone, v, {0, 1000, " Dobson units"});
     }},
    {"altitude", "M", "Of the viewer above the ground, metres", "Air", setAltitude},
    {"atmosphere", "NAME|FILE.json",
     "clear, reference, standard, hazy or pure, or a file (default: clear)", "Air",
     [](SkyRequest& r, std::string_view v) -> Status {
       if (v.empty()) return badUsage("the name of an atmosphere or of a file is missing");
       r.atmosphere = v;
       return Status::ok();
     }},
    {"direct-normal", "W/M2", "Direct irradiance, of perez and asrc-cie", "Model",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.directNormal, v, {0, 2000, " W/m²"});
     }},
    {"diffuse-horizontal", "W/M2", "Diffuse irradiance, of perez and asrc-cie", "Model",
     [](SkyRequest& r, std::string_view v) {
       return setNumber(r.diffuseHorizontal, v, {0, 2000, " W/m²"});
     }},
    {"refine", "STEPS", "Makes the discretisation of exact finer, 0 to 3 (default: 0)", "Model",
     setRefine},
};

Error unknownKey(std::string_view key) {
  std::string all;
  const RequestKey* nearest = nullptr;
  std::size_t least = 4;
  for (const RequestKey& each : kKeys) {
    all += fmt::format("{}{}", all.empty() ? "" : ", ", each.key);
    std::size_t apart = editDistance(key, each.key);
    if (key.size() > 2 && (key.starts_with(each.key) || each.key.starts_with(key))) apart = 1;
    if (apart < least && apart < std::max<std::size_t>(each.key.size(), 2)) {
      least = apart;
      nearest = &each;
    }
  }
  return badUsage(fmt::format("there is no key '{}'{}; the keys are {}", key,
                              nearest ? fmt::format(": did you mean {}?", nearest->key) : "", all));
}

/// "date, time and lon"
std::string listed(const std::vector<std::string_view>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == words.size() ? " and " : ", ", words[i]);
  return text;
}

/// What stands where, of a request that says both or neither.
struct SunPlace {
  double elevation, bearing;  ///< as it is seen, rad
  double distance;            ///< AU
  std::optional<double> trueElevation;
};

Result<SunPlace> sunByMoment(const SkyRequest& request) {
  std::vector<std::string_view> missing;
  if (!request.date) missing.push_back("date");
  if (!request.time) missing.push_back("time");
  if (!request.latitude) missing.push_back("lat");
  if (!request.longitude) missing.push_back("lon");
  if (!missing.empty())
    return badUsage(fmt::format("{} {} missing: the Sun of a moment takes date, time, lat and lon",
                                listed(missing), missing.size() > 1 ? "are" : "is"));
  const auto moment = astronomy::parseMoment(*request.date, *request.time, request.utcOffset);
  if (!moment) return moment.error();
  const auto place =
      astronomy::placeFromDegrees(*request.latitude, *request.longitude, request.altitude);
  if (!place) return place.error();
  const astronomy::Topocentric sun = astronomy::apparentSun(*moment, *place);
  const astronomy::Horizontal seen =
      astronomy::refracted(sun.direction, astronomy::standardAir(request.altitude));
  return SunPlace{seen.elevation, seen.azimuth, sun.distance / astronomy::kAstronomicalUnit,
                  sun.direction.elevation};
}

Result<SunPlace> sunOf(const SkyRequest& request) {
  const bool moment = request.date || request.time || request.latitude || request.longitude;
  if (moment && (request.sunElevation || request.sunAzimuth))
    return badUsage(
        "date, time, lat and lon say where the Sun stands, and so do sun-elevation and "
        "sun-azimuth: give one of them");
  if (moment) return sunByMoment(request);
  if (!request.sunElevation)
    return badUsage(fmt::format(
        "where the Sun stands is missing: give {}date, time, lat and lon",
        request.sunAzimuth ? "sun-elevation with sun-azimuth, or " : "sun-elevation, or "));
  return SunPlace{*request.sunElevation * kRadians, request.sunAzimuth.value_or(180) * kRadians, 1,
                  std::nullopt};
}

Result<Atmosphere> atmosphereOf(const SkyRequest& request) {
  std::optional<Atmosphere> atmosphere = preset(request.atmosphere);
  if (!atmosphere) {
    const std::filesystem::path path(request.atmosphere);
    std::error_code ignored;
    if (path.extension() != ".json" && !std::filesystem::exists(path, ignored)) {
      std::string names;
      for (const std::string_view name : presets())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
      return badUsage(fmt::format("atmosphere '{}' is neither a FILE.json nor one of {}",
                                  request.atmosphere, names));
    }
    Result<Atmosphere> read = readAtmosphere(path);
    if (!read) return read.error();
    atmosphere = std::move(*read);
  }
  if (request.turbidity) *atmosphere = withTurbidity(std::move(*atmosphere), *request.turbidity);
  if (request.albedo) atmosphere->groundAlbedo = Spectral::constant(*request.albedo);
  if (request.ozone) atmosphere->ozone = *request.ozone;
  if (request.altitude > atmosphere->height)
    return badUsage(fmt::format("altitude {} m is in space: the atmosphere '{}' ends at {} m",
                                request.altitude, atmosphere->name, atmosphere->height));
  return std::move(*atmosphere);
}

bool isSimulated(Model model) {
  return model == Model::Exact || model == Model::Fast;
}

Status checkModel(const SkyRequest& request) {
  const bool measured = request.model == Model::Perez || request.model == Model::AsrcCie;
  if ((request.directNormal || request.diffuseHorizontal) && !measured)
    return badUsage(fmt::format("{} is of the models perez and asrc-cie: give model=perez",
                                request.directNormal ? "direct-normal" : "diffuse-horizontal"));
  if (request.refine > 0 && request.model != Model::Exact)
    return badUsage("refine is of the model exact: give model=exact");
  return Status::ok();
}

}  // namespace

std::span<const RequestKey> requestKeys() {
  return kKeys;
}

Status setKey(SkyRequest& request, std::string_view key, std::string_view value) {
  for (const RequestKey& each : kKeys) {
    if (each.key != key) continue;
    if (const Status status = each.set(request, value); !status)
      return badUsage(fmt::format("{}: {}", key, status.error().message));
    return Status::ok();
  }
  return unknownKey(key);
}

std::size_t endOfRequestValue(std::string_view text, std::size_t at) {
  constexpr std::string_view kFileKey = "atmosphere=";
  const bool file = text.substr(0, at).ends_with(kFileKey);
  std::size_t first = text.size(), asFile = 0;
  for (std::size_t i = at; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != ',' && text[i] != '+') continue;
    const auto digit = [&](std::size_t k) {
      return k < i && (text[k] == '.' || (text[k] >= '0' && text[k] <= '9'));
    };
    const bool sign =
        i < text.size() && text[i] == '+' &&
        (i == at || (!file && i >= at + 2 && (text[i - 1] | 32) == 'e' && digit(i - 2)));
    if (sign) continue;
    first = std::min(first, i);
    if (!file) break;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(std::string(text.substr(at, i - at)), ignored)) asFile = i;
  }
  return asFile ? asFile : first;
}

Result<SkyRequest> parseRequest(std::string_view text) {
  SkyRequest request;
  std::vector<std::string_view> seen;
  for (std::size_t at = 0; at <= text.size();) {
    const std::string_view rest = text.substr(at);
    const std::size_t equals = rest.find('=');
    if (equals == rest.npos || rest.find(',') < equals)
      return badUsage(fmt::format("'{}' is not KEY=VALUE", rest.substr(0, rest.find(','))));
    const std::string_view key = rest.substr(0, equals);
    const std::size_t begin = at + equals + 1, end = endOfRequestValue(text, begin);
    const std::string_view value = text.substr(begin, end - begin);
    if (end < text.size() && text[end] == '+')
      return badUsage(fmt::format("'{}': what follows the '+' is no part of it", key));
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      return badUsage(fmt::format("'{}' is given twice", key));
    seen.push_back(key);
    if (const Status status = setKey(request, key, value); !status) return status.error();
    at = end + 1;
  }
  return request;
}

Result<WithFindings<ResolvedSky>> resolve(const SkyRequest& request) {
  if (const Status status = checkModel(request); !status) return status.error();
  const Result<SunPlace> sun = sunOf(request);
  if (!sun) return sun.error();
  if (sun->elevation < kNight * kRadians - 1e-9)
    return badUsage(
        fmt::format("the Sun stands at {:.2f} degrees: below {} it is night, and there is no "
                    "sky of the Sun's",
                    sun->elevation / kRadians, kNight));
  Result<Atmosphere> atmosphere = atmosphereOf(request);
  if (!atmosphere) return atmosphere.error();

  WithFindings<ResolvedSky> made;
  ResolvedSky& resolved = made.value;
  resolved.options.model = request.model;
  resolved.options.cieType = request.cieType;
  resolved.options.atmosphere = std::move(*atmosphere);
  resolved.options.sunElevation = std::max(sun->elevation, kNight * kRadians);
  resolved.options.sunDistance = sun->distance;
  resolved.options.altitude = request.altitude;
  resolved.options.directNormalIrradiance = request.directNormal;
  resolved.options.diffuseHorizontalIrradiance = request.diffuseHorizontal;
  resolved.options.refine = request.refine;
  resolved.sunBearing = sun->bearing;
  resolved.trueElevation = sun->trueElevation;
  resolved.worldFromSun = worldFromSunAt(sun->bearing);
  if (request.altitude > 0 && !isSimulated(request.model))
    made.findings.push_back({Severity::Warning, "sky-altitude-unused",
                             "altitude is of the models exact and fast; this one's skies are seen "
                             "from the ground",
                             1});
  return made;
}

Mat3d worldFromSunAt(double bearing) {
  const double x = std::sin(bearing), z = -std::cos(bearing);
  Mat3d worldFromSun;
  worldFromSun << x, 0, -z,  //
      0, 1, 0,               //
      z, 0, x;
  return worldFromSun;
}

}  // namespace lambent::sky
