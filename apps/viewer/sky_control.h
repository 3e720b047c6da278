// The sky under the hand: what the panel's sliders and a script's `sky` change, and the SOURCE that
// they come to.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lambent/light/environment.h"
#include "lambent/report/result.h"
#include "lambent/sky/sky_request.h"

namespace lambent::viewer {

/// What a SOURCE says, if it is a sky and nothing else.
std::optional<sky::SkyRequest> skyOf(std::string_view source);
/// Noon of midsummer in Geneva.
sky::SkyRequest firstSky();

/// Whether the Sun stands where a moment and a place put it, or where it was said to stand.
bool byMoment(const sky::SkyRequest& request);
/// The other way round, with a Sun or a moment to begin with.
void goByMoment(sky::SkyRequest& request, bool moment);
/// One key as `lambent sky` takes it. A key of the moment replaces a Sun that was said, and the
/// other way round.
Status change(sky::SkyRequest& request, std::string_view key, std::string_view value);

/// Of the day, 0 … 1440; 1440 is its last second.
int minuteOf(const sky::SkyRequest& request);
void setMinute(sky::SkyRequest& request, int minute);

/// Whether two skies are made from the same table: then one follows the other in milliseconds.
bool sameAir(const sky::SkyRequest& a, const sky::SkyRequest& b);

/// A city to stand in; its clock without summer time.
struct City {
  const char* name;
  double latitude, longitude;  ///< degrees
  double utcOffset;            ///< hours
};
std::span<const City> cities();

/// Degrees: elevation as the Sun is seen, compass bearing.
struct SunPosition {
  double elevation, bearing;
};
/// Nothing of a request whose moment or place is none.
std::optional<SunPosition> sunPositionOf(const sky::SkyRequest& request);

struct ShownSky {
  std::string source;
  std::string remark;  ///< why this is not the moment that was asked for; empty if it is
};
/// The SOURCE of a sky. There is none of the Sun's at night: then it is the sky of the nearest
/// moment of that day (by minutes) with a Sun no lower than −18°, or, where it stays lower all day,
/// of a Sun at −18°, and the remark says so.
ShownSky shownSky(const sky::SkyRequest& request);

/// The exposure (EV) at which a light is neither dark nor white: its mean radiance over the sphere
/// becomes ½.
double exposureFor(const light::Environment& environment);

}  // namespace lambent::viewer
