#include "web/sky_data/fixture.h"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sight.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/sky_request.h"

namespace lambent::page {
namespace {

struct Case {
  const char* model;
  double turbidity, sunElevation;  ///< degrees
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const double sun : {90., 60., 30., 15., 10., 5., 2., 0.2, 0., -2., -4., -6., -12., -17.})
    for (const double turbidity : {2.5, 1., 1.12, 4.5, 9.})
      if (turbidity == 2.5 || sun == 60 || sun == 10 || sun == 0 || sun == -6)
        all.push_back({"fast", turbidity, sun});
  for (const char* model : {"preetham", "cie-clear", "cie-overcast", "cie:3", "cie:12"})
    for (const double sun : {70., 12., 0.1, -5.})
      for (const double turbidity : {2.5, 6.}) all.push_back({model, turbidity, sun});
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
          std::pair{"sun-azimuth", std::string("90")}})
      if (const Status status = sky::setKey(request, key, value); !status) return status.error();
    auto resolved = sky::resolve(request);
    if (!resolved) return resolved.error();
    resolved->value.options.cache = sky::cacheFolder();
    const auto made = maker.make(resolved->value.options);
    if (!made) return made.error();
    const sky::Sky& sky = made->value;
    json += fmt::format(
        "{}\n{{\"model\":\"{}\",\"turbidity\":{},\"sunElevation\":{},\"sun\":{},\"ground\":{},"
        "\"radiance\":[",
        first ? "" : ",", each.model, each.turbidity, each.sunElevation,
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

}  // namespace lambent::page
