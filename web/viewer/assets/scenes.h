// What the page shows before anybody has dropped a file on it.
#pragma once

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/report/result.h"

namespace lambent::page {

/// A glazed jar, matt stones and a mirror ring that throws a caustic, on a pale plinth.
Result<asset::Asset> stillLife();
/// A knot of woven cloth: meso-structure by the knot's own UVs.
Result<asset::Asset> wovenKnot();

/// Environments by formula, in latitude and longitude.
image::Image studioLight();  ///< dark, with a large warm panel, a cool one and a strip
image::Image eveningSky();   ///< a low sun behind haze over a dark ground

}  // namespace lambent::page
