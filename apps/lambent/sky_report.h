// What `lambent sky` says of a sky: rows of numbers, and how bright it is there.
#pragma once

#include <string>
#include <vector>

#include "apps/lambent/console.h"
#include "apps/lambent/sky_arguments.h"
#include "lambent/sky/reading.h"
#include "lambent/sky/sky_request.h"

namespace lambent::tool {

/// A moment and what was read of it.
struct SkyMoment {
  std::string time;  ///< "2026-06-21 05:40:00", of a sequence; else empty
  sky::ResolvedSky resolved;
  sky::Brightness brightness;
  std::vector<sky::Reading> readings;  ///< one for each direction
  std::string output;                  ///< the picture, if there is one
};

/// What the rows are of.
struct SkyTable {
  std::vector<AtArguments::Direction> directions;
  std::vector<double> wavelengths;
  bool magnitudes = false;
};

/// azimuth,elevation,450,…,luminance[,mag_arcsec2]; of a sequence with time,sun_elevation before.
std::string csvOf(const SkyTable& table, const std::vector<SkyMoment>& moments);
Json jsonOf(const SkyTable& table, const SkyMoment& moment);
/// For a person: Sun, illuminance, zenith.
std::string textOf(const SkyTable& table, const SkyMoment& moment);

/// Below this elevation of the Sun, rad, people ask for magnitudes: the end of civil twilight.
inline constexpr double kMagnitudesBelow = -6 * kPi / 180;

}  // namespace lambent::tool
