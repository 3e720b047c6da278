#include "apps/viewer/sky_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lambent/astronomy/moment.h"
#include "lambent/astronomy/place.h"
#include "lambent/astronomy/refraction.h"
#include "lambent/astronomy/sun.h"
#include "lambent/radiometry/luminance.h"

namespace lambent::viewer {

namespace {

constexpr std::string_view kSkyWord = "sky:";
constexpr double kNight = -18;  // degrees: the end of astronomical twilight
constexpr int kDay = 24 * 60;   // minutes

bool isAmong(std::string_view key, std::initializer_list<std::string_view> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::string clockOf(int minute) {
  if (minute >= kDay) return "23:59:59";
  return fmt::format("{:02}:{:02}", minute / 60, minute % 60);
}

/// With a moment whole enough to have a Sun.
void completeMoment(sky::SkyRequest& request) {
  const sky::SkyRequest first = firstSky();
  request.sunElevation.reset(), request.sunAzimuth.reset();
  if (!request.latitude && !request.longitude && !request.date && !request.time)
    request.utcOffset = first.utcOffset;
  if (!request.date) request.date = first.date;
  if (!request.time) request.time = first.time;
  if (!request.latitude) request.latitude = first.latitude;
  if (!request.longitude) request.longitude = first.longitude;
}

void dropMoment(sky::SkyRequest& request) {
  request.date.reset(), request.time.reset();
  request.latitude.reset(), request.longitude.reset();
  request.utcOffset = 0;
}

}  // namespace

std::optional<sky::SkyRequest> skyOf(std::string_view source) {
  if (!source.starts_with(kSkyWord)) return std::nullopt;
  // What another light is added to is refused there.
  auto request = sky::parseRequest(source.substr(kSkyWord.size()));
  if (!request) return std::nullopt;
  return std::move(*request);
}

sky::SkyRequest firstSky() {
  sky::SkyRequest request;
  request.date = "2026-06-21", request.time = "12:00";
  const City& city = cities().front();
  request.utcOffset = city.utcOffset;
  request.latitude = city.latitude, request.longitude = city.longitude;
  return request;
}

bool byMoment(const sky::SkyRequest& request) {
  return !request.sunElevation && !request.sunAzimuth;
}

void goByMoment(sky::SkyRequest& request, bool moment) {
  if (moment == byMoment(request)) return;
  if (moment) return completeMoment(request);
  const auto sun = sunPositionOf(request);
  dropMoment(request);
  request.sunElevation = sun ? std::round(std::max(sun->elevation, kNight) * 10) / 10 : 30.0;
  request.sunAzimuth = sun ? std::round(sun->bearing * 10) / 10 : 180.0;
}

Status change(sky::SkyRequest& request, std::string_view key, std::string_view value) {
  sky::SkyRequest next = request;
  if (isAmong(key, {"sun-elevation", "sun-azimuth"})) goByMoment(next, false);
  if (isAmong(key, {"date", "time", "utc-offset", "lat", "lon"})) goByMoment(next, true);
  if (Status status = sky::setKey(next, key, value); !status) return status;
  request = std::move(next);
  return Status::ok();
}

int minuteOf(const sky::SkyRequest& request) {
  const auto moment = astronomy::parseMoment("2000-06-01", request.time.value_or("12:00"), 0);
  return moment ? int(std::lround(moment->second / 60)) : kDay / 2;
}

void setMinute(sky::SkyRequest& request, int minute) {
  request.time = clockOf(std::clamp(minute, 0, kDay));
}

bool sameAir(const sky::SkyRequest& a, const sky::SkyRequest& b) {
  return a.model == b.model && a.atmosphere == b.atmosphere && a.turbidity == b.turbidity &&
         a.albedo == b.albedo && a.ozone == b.ozone && a.altitude == b.altitude;
}

std::span<const City> cities() {
  static constexpr City kCities[] = {
      {"Geneva", 46.2, 6.15, 1},       {"Longyearbyen", 78.22, 15.65, 1},
      {"Reykjavik", 64.15, -21.94, 0}, {"London", 51.51, -0.13, 0},
      {"New York", 40.71, -74.01, -5}, {"Tokyo", 35.68, 139.69, 9},
      {"Cairo", 30.04, 31.24, 2},      {"Singapore", 1.35, 103.82, 8},
      {"Quito", -0.18, -78.47, -5},    {"Cape Town", -33.92, 18.42, 2},
      {"Sydney", -33.87, 151.21, 10},  {"Ushuaia", -54.8, -68.3, -3},
  };
  return kCities;
}

std::optional<SunPosition> sunPositionOf(const sky::SkyRequest& request) {
  if (!byMoment(request))
    return SunPosition{request.sunElevation.value_or(30), request.sunAzimuth.value_or(180)};
  if (!request.date || !request.time || !request.latitude || !request.longitude)
    return std::nullopt;
  const auto moment = astronomy::parseMoment(*request.date, *request.time, request.utcOffset);
  const auto place =
      astronomy::placeFromDegrees(*request.latitude, *request.longitude, request.altitude);
  if (!moment || !place) return std::nullopt;
  const astronomy::Horizontal seen = astronomy::refracted(
      astronomy::apparentSun(*moment, *place).direction, astronomy::standardAir(request.altitude));
  return SunPosition{seen.elevation * 180 / kPi, seen.azimuth * 180 / kPi};
}

ShownSky shownSky(const sky::SkyRequest& request) {
  const auto textOf = [](const sky::SkyRequest& of) {
    return std::string(kSkyWord) + sky::toText(of);
  };
  const auto sun = sunPositionOf(request);
  if (!sun || sun->elevation >= kNight) return {textOf(request), ""};
  sky::SkyRequest twilight = request;
  const int minute = byMoment(request) ? minuteOf(request) : 0;
  for (int apart = 1; byMoment(request) && apart < kDay; ++apart)
    for (const int at : {minute - apart, minute + apart}) {
      if (at < 0 || at >= kDay) continue;
      setMinute(twilight, at);
      const auto there = sunPositionOf(twilight);
      if (there && there->elevation >= kNight)
        return {textOf(twilight),
                fmt::format("Night: the Sun is {:.0f}° below the horizon. Shown: {}, the edge of "
                            "the night.",
                            -sun->elevation, *twilight.time)};
    }
  dropMoment(twilight);
  twilight.sunElevation = kNight, twilight.sunAzimuth = sun->bearing;
  return {textOf(twilight), fmt::format("Night: the Sun is {:.0f}° below the horizon. Shown: as "
                                        "if it stood at {:.0f}°.",
                                        -sun->elevation, kNight)};
}

double exposureFor(const light::Environment& environment) {
  const std::vector<float> light = environment.project(1).values;
  // The first harmonic is 1/√(4π): its coefficient is √(4π) times the mean.
  const double mean =
      double(radiometry::luminance(Rgb(light[0], light[1], light[2]))) / std::sqrt(4 * kPi);
  return mean > 0 ? std::clamp(std::log2(0.5 / mean), -30.0, 30.0) : 0.0;
}

}  // namespace lambent::viewer
