#include "apps/lambent/sky_report.h"

#include <fmt/format.h>

#include <cmath>

#include "lambent/radiometry/spectra.h"

namespace lambent::tool {

namespace {

constexpr double kDegree = kPi / 180;

/// Eight digits, more than a float has.
std::string number(double value) {
  return fmt::format("{:.8g}", value);
}

/// Empty where there is no light at all.
std::string magnitude(double luminance) {
  const double magnitudes = radiometry::magnitudesPerSquareArcsecond(luminance);
  return std::isfinite(magnitudes) ? fmt::format("{:.6g}", magnitudes) : "";
}

Json magnitudeAsJson(double luminance) {
  const double magnitudes = radiometry::magnitudesPerSquareArcsecond(luminance);
  return std::isfinite(magnitudes) ? Json(magnitudes) : Json(nullptr);
}

double elevationOf(const SkyMoment& moment) {
  return moment.resolved.options.sunElevation / kDegree;
}

double bearingOf(const SkyMoment& moment) {
  const double bearing = std::fmod(moment.resolved.sunBearing / kDegree, 360);
  return bearing < 0 ? bearing + 360 : bearing;
}

Json asJson(const sky::Arriving& arriving) {
  return {{"direct_normal", arriving.directNormal},
          {"direct_horizontal", arriving.direct},
          {"diffuse_horizontal", arriving.diffuse},
          {"global_horizontal", arriving.global()}};
}

/// 123456 → "123,456"; small numbers with three digits.
std::string inShort(double value) {
  if (value < 1000) return fmt::format("{:.3g}", value);
  return formatCount(std::uint64_t(std::llround(value)));
}

}  // namespace

std::string csvOf(const SkyTable& table, const std::vector<SkyMoment>& moments) {
  const bool times = !moments.empty() && !moments.front().time.empty();
  std::string csv = times ? "time,sun_elevation,azimuth,elevation" : "azimuth,elevation";
  for (const double nm : table.wavelengths) csv += fmt::format(",{:g}", nm);
  csv += table.magnitudes ? ",luminance,mag_arcsec2\n" : ",luminance\n";
  for (const SkyMoment& moment : moments) {
    for (std::size_t i = 0; i < moment.readings.size(); ++i) {
      const sky::Reading& reading = moment.readings[i];
      if (times) csv += moment.time + ',' + number(elevationOf(moment)) + ',';
      csv += number(table.directions[i].azimuth) + ',' + number(table.directions[i].elevation);
      for (const double radiance : reading.radiance) csv += ',' + number(radiance);
      csv += ',' + number(reading.luminance);
      if (table.magnitudes) csv += ',' + magnitude(reading.luminance);
      csv += '\n';
    }
  }
  return csv;
}

Json jsonOf(const SkyTable& table, const SkyMoment& moment) {
  Json json = Json::object();
  if (!moment.time.empty()) json["time"] = moment.time;
  if (!moment.output.empty()) json["output"] = moment.output;
  json["sun"] = {{"azimuth", bearingOf(moment)},
                 {"elevation", elevationOf(moment)},
                 {"distance_au", moment.resolved.options.sunDistance}};
  if (moment.resolved.trueElevation)
    json["sun"]["true_elevation"] = *moment.resolved.trueElevation / kDegree;
  json["irradiance"] = asJson(moment.brightness.irradiance);
  json["illuminance"] = asJson(moment.brightness.illuminance);
  json["zenith"] = {{"luminance", moment.brightness.zenithLuminance},
                    {"mag_arcsec2", magnitudeAsJson(moment.brightness.zenithLuminance)}};
  if (moment.readings.empty()) return json;
  if (!table.wavelengths.empty()) json["wavelengths"] = table.wavelengths;
  Json& rows = json["at"] = Json::array();
  for (std::size_t i = 0; i < moment.readings.size(); ++i) {
    Json row = {{"azimuth", table.directions[i].azimuth},
                {"elevation", table.directions[i].elevation}};
    if (!table.wavelengths.empty()) row["radiance"] = moment.readings[i].radiance;
    row["luminance"] = moment.readings[i].luminance;
    if (table.magnitudes) row["mag_arcsec2"] = magnitudeAsJson(moment.readings[i].luminance);
    rows.push_back(row);
  }
  return json;
}

std::string textOf(const SkyTable& table, const SkyMoment& moment) {
  const auto line = [](const char* name, const sky::Arriving& lx, const sky::Arriving& watts,
                       double sky::Arriving::*part) {
    return fmt::format("{:<24}{:>12} lx {:>9} W/m²\n", name, inShort(lx.*part),
                       inShort(watts.*part));
  };
  const sky::Arriving& lx = moment.brightness.illuminance;
  const sky::Arriving& watts = moment.brightness.irradiance;
  std::string text =
      fmt::format("Sun: {:.2f}° above the horizon as it is seen, bearing {:.2f}°, {:.4f} AU away\n",
                  elevationOf(moment), bearingOf(moment), moment.resolved.options.sunDistance);
  if (elevationOf(moment) < 0)
    text =
        fmt::format("Sun: {:.2f}° below the horizon, bearing {:.2f}°, {:.4f} AU away\n",
                    -elevationOf(moment), bearingOf(moment), moment.resolved.options.sunDistance);
  text += line("Sun, facing it", lx, watts, &sky::Arriving::directNormal);
  text += line("Sun, on the ground", lx, watts, &sky::Arriving::direct);
  text += line("Sky, on the ground", lx, watts, &sky::Arriving::diffuse);
  text += fmt::format("{:<24}{:>12} lx {:>9} W/m² (340 to 740 nm)\n", "Both, on the ground",
                      inShort(lx.global()), inShort(watts.global()));
  text += fmt::format("{:<24}{:>12} cd/m²", "Zenith", inShort(moment.brightness.zenithLuminance));
  const std::string magnitudes = magnitude(moment.brightness.zenithLuminance);
  if (table.magnitudes && !magnitudes.empty())
    text +=
        fmt::format(" {:>6.2f} mag/arcsec²",
                    radiometry::magnitudesPerSquareArcsecond(moment.brightness.zenithLuminance));
  return text + "\n";
}

}  // namespace lambent::tool
