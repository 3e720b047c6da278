#include "lambent/astronomy/place.h"

#include <fmt/format.h>

#include "lambent/math/types.h"

namespace lambent::astronomy {

Result<Place> placeFromDegrees(double latitude, double longitude, double altitude) {
  if (!(latitude >= -90 && latitude <= 90))
    return report::badUsage(
        fmt::format("the latitude {}: degrees from -90 (south) to 90 (north)", latitude));
  if (!(longitude >= -180 && longitude <= 180))
    return report::badUsage(
        fmt::format("the longitude {}: degrees from -180 (west) to 180 (east)", longitude));
  if (!(altitude >= -500 && altitude <= 100000))
    return report::badUsage(
        fmt::format("the altitude {}: metres from -500 to 100000 above the sea", altitude));
  return Place{latitude * kPi / 180, longitude * kPi / 180, altitude};
}

}  // namespace lambent::astronomy
