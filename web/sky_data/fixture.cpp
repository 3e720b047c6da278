#include "web/sky_data/fixture.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lambent/math/directions.h"
#include "lambent/radiometry/spectra.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/make_aerial_perspective.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sight.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/sky_request.h"

namespace lambent::page {
namespace {

struct Case {
  const char* model;
  double turbidity, sunElevation;                   ///< degrees
  std::optional<double> direct = {}, diffuse = {};  ///< W m⁻², as measured
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const double sun : {90., 60., 30., 15., 10., 5., 2., 0.2, 0., -2., -4., -6., -12., -17.})
    for (const double turbidity : {2.5, 1., 1.12, 4.5, 9.})
      if (turbidity == 2.5 || sun == 60 || sun == 10 || sun == 0 || sun == -6)
        all.push_back({"fast", turbidity, sun});
  for (const char* model :
       {"preetham", "cie-clear", "cie-overcast", "cie:3", "cie:12", "perez", "asrc-cie"})
    for (const double sun : {70., 12., 0.1, -5.})
      for (const double turbidity : {2.5, 6.}) all.push_back({model, turbidity, sun});
  // From overcast to very clear; the last two beside a border of clearness.
  for (const char* model : {"perez", "asrc-cie"})
    for (const auto& [direct, diffuse] :
         {std::pair(0., 120.), std::pair(60., 250.), std::pair(250., 220.), std::pair(500., 160.),
          std::pair(850., 60.), std::pair(0., 0.), std::pair(98., 300.), std::pair(104., 300.)})
      for (const double sun : {55., 14.}) all.push_back({model, 2.5, sun, direct, diffuse});
  return all;
}

/// Towards all azimuths at elevations that lie closer to each other at the horizon.
std::vector<Vec3d> directions() {
  std::vector<Vec3d> all;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const double t = (i + 0.5) / 8, elevation = kPi / 2 * t * t, azimuth = kPi * (j + 0.5) / 8;
      all.emplace_back(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                       std::cos(elevation) * std::sin(azimuth));
    }
  return all;
}

template <class Three>
std::string triple(const Three& value) {
  return fmt::format("[{:.5g},{:.5g},{:.5g}]", value[0], value[1], value[2]);
}

}  // namespace

Result<std::string> skyFixture() {
  std::string json = "{\"directions\":[";
  const std::vector<Vec3d> towards = directions();
  for (std::size_t i = 0; i < towards.size(); ++i)
    json += fmt::format("{}[{:.6f},{:.6f},{:.6f}]", i ? "," : "", towards[i].x(), towards[i].y(),
                        towards[i].z());
  json += "],\n\"skies\":[";
  sky::SkyMaker maker;
  bool first = true;
  for (const Case& each : cases()) {
    sky::SkyRequest request;
    for (const auto& [key, value] :
         {std::pair{"model", std::string(each.model)},
          std::pair{"turbidity", fmt::format("{}", each.turbidity)},
          std::pair{"sun-elevation", fmt::format("{}", each.sunElevation)},
          std::pair{"sun-azimuth", std::string("90")},
          std::pair{"direct-normal", each.direct ? fmt::format("{}", *each.direct) : ""},
          std::pair{"diffuse-horizontal", each.diffuse ? fmt::format("{}", *each.diffuse) : ""}})
      if (const Status status = value.empty() ? Status::ok() : sky::setKey(request, key, value);
          !status)
        return status.error();
    auto resolved = sky::resolve(request);
    if (!resolved) return resolved.error();
    resolved->value.options.cache = sky::cacheFolder();
    const auto made = maker.make(resolved->value.options);
    if (!made) return made.error();
    const sky::Sky& sky = made->value;
    const std::string measured = each.direct
                                     ? fmt::format("\"directNormal\":{},\"diffuseHorizontal\":{},",
                                                   *each.direct, *each.diffuse)
                                     : "";
    json += fmt::format(
        "{}\n{{\"model\":\"{}\",\"turbidity\":{},\"sunElevation\":{},{}\"sun\":{},\"ground\":{},"
        "\"radiance\":[",
        first ? "" : ",", each.model, each.turbidity, each.sunElevation, measured,
        triple(sky::radianceRgb(sky.sun.irradiance)), triple(sky::radianceRgb(sky.ground)));
    first = false;
    for (std::size_t i = 0; i < towards.size(); ++i)
      json += (i ? "," : "") + triple(sky::radianceRgb(sky.dome->color(towards[i])));
    json += "],\"coefficients\":[";
    const sh::RgbCoefficients c = sky::environmentOf(sky, resolved->value.worldFromSun).project(5);
    for (std::size_t i = 0; i < 25; ++i)
      json += (i ? "," : "") + triple(std::array{c.values[i], c.values[25 + i], c.values[50 + i]});
    json += "]}";
  }
  return json + "]}\n";
}

Result<std::string> airFixture() {
  std::vector<Vec3d> towards;
  for (const double elevation : {-30., -3., -.3, .1, .5, 1.5, 4., 12., 35., 80.})
    for (const double azimuth : {2., 50., 110., 178.})
      towards.emplace_back(
          math::directionFromAzimuthElevation(azimuth * kPi / 180, elevation * kPi / 180));
  const std::vector<double> distances = {100, 400, 1500, 5000, 15000, 40000, 100000};
  std::string json = "{\"directions\":[";
  for (std::size_t i = 0; i < towards.size(); ++i)
    json += fmt::format("{}[{:.7f},{:.7f},{:.7f}]", i ? "," : "", towards[i].x(), towards[i].y(),
                        towards[i].z());
  json += fmt::format("],\n\"distances\":[{}],\n\"airs\":[", fmt::join(distances, ","));
  bool first = true;
  sky::AirMaker maker;
  for (const double turbidity : {2.5, 1.3, 6.})
    for (const double sun : {90., 60., 30., 12., 5., 2., .5, 0., -1., -2.5, -4.}) {
      if (turbidity != 2.5 && sun != 60 && sun != 5 && sun != -1) continue;
      sky::SkyOptions options;
      options.atmosphere = sky::withTurbidity(*sky::preset("clear"), turbidity);
      options.sunElevation = sun * kPi / 180;
      const auto air = maker.make(options, sky::AerialForm::Table);
      if (!air) return air.error();
      std::string extinction, scattered;
      for (const Vec3d& direction : towards)
        for (const double distance : distances) {
          const sky::AirBetween between = sky::airBetween(air->value, direction, distance);
          extinction += (extinction.empty() ? "" : ",") + triple(between.extinction);
          scattered += (scattered.empty() ? "" : ",") + triple(between.inScattered());
        }
      json += fmt::format(
          "{}\n{{\"turbidity\":{},\"sunElevation\":{},\"extinction\":[{}],\"inScattered\":[{}]}}",
          first ? "" : ",", turbidity, sun, extinction, scattered);
      first = false;
    }
  return json + "]}\n";
}

}  // namespace lambent::page
