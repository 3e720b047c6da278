// What a person says of a sky, in words: the keys of the SOURCE `sky:KEY=VALUE,…` and the options of
// `lambent sky --KEY VALUE`, which are the same. One table says how each is written and read.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/sky/make_sky.h"

namespace lambent::sky {

/// Angles in degrees here: this is the edge of the tool. Nothing: the person did not say.
struct SkyRequest {
  std::optional<std::string> date, time;  ///< "2026-06-21", "05:40" or "05:40:30"
  double utcOffset = 0;                   ///< hours east of UTC
  std::optional<double> latitude, longitude;
  /// Instead of date, time and place. The azimuth is a compass bearing (north 0, east 90).
  std::optional<double> sunElevation, sunAzimuth;
  Model model = Model::Fast;
  int cieType = 12;
  std::string atmosphere = "clear";  ///< a preset's name, or the path of a .json
  std::optional<double> turbidity, albedo, ozone;
  std::optional<double> directNormal, diffuseHorizontal;  ///< W m⁻², of Perez and ASRC-CIE
  double altitude = 0;                                    ///< m
  int refine = 0;
};

struct RequestKey {
  std::string_view key;     ///< "utc-offset"
  std::string_view syntax;  ///< "HOURS"
  std::string_view help;    ///< a line for a person
  std::string_view group;   ///< "Moment", "Sun", "Air", "Model"
  Status (*set)(SkyRequest&,
                std::string_view value);  ///< BadUsage says what is wrong and the range
};
std::span<const RequestKey> requestKeys();

/// Sets one by its name. BadUsage begins with the key; an unknown one gets the nearest and the list.
Status setKey(SkyRequest& request, std::string_view key, std::string_view value);

/// KEY=VALUE,KEY=VALUE,… A ',' in the name of an atmosphere's file that is there does not divide.
Result<SkyRequest> parseRequest(std::string_view text);
/// The same from the request: what parseRequest() reads back with every number as it was. What has
/// its default is left out; of a request that says nothing it is empty.
std::string toText(const SkyRequest& request);

/// Where the value that begins at `at` (after its '=') ends: at the next ',' or '+', or with the
/// text. A '+' that is a number's sign or in its exponent is part of it, and so are both in the name
/// of an atmosphere's file that is there.
std::size_t endOfRequestValue(std::string_view text, std::size_t at);

/// A request with its Sun found.
struct ResolvedSky {
  SkyOptions options;
  double sunBearing = 0;  ///< compass bearing of the Sun, rad
  /// Of the Sun without refraction, rad; nothing where a person said how high it is seen.
  std::optional<double> trueElevation;
  /// Turns the Sun's frame of a Dome to the world: +x of the frame to the Sun's azimuth.
  Mat3d worldFromSun = Mat3d::Identity();
};
/// BadUsage: what is missing (a date without a place, …) or contradicts; BadInput: a file.
/// A Sun below −18° is refused with its elevation: that is night.
Result<WithFindings<ResolvedSky>> resolve(const SkyRequest& request);

/// That matrix for a compass bearing, rad.
Mat3d worldFromSunAt(double bearing);

}  // namespace lambent::sky
