// Where an observer stands on the Earth.
#pragma once

#include "lambent/report/result.h"

namespace lambent::astronomy {

struct Place {
  double latitude = 0;   ///< rad, geodetic (WGS 84), −π/2 … π/2, north positive
  double longitude = 0;  ///< rad, −π … π, east positive
  double altitude = 0;   ///< m above the ellipsoid
};

/// From degrees, −90 … 90 and −180 … 180 (east positive), and metres, −500 … 100 000. BadUsage for
/// what is outside of these or no number.
Result<Place> placeFromDegrees(double latitude, double longitude, double altitude = 0);

}  // namespace lambent::astronomy
