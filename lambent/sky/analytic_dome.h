// Analytic skies as domes: what has luminance alone becomes daylight of one colour.
#pragma once

#include <functional>
#include <memory>

#include "lambent/sky/dome.h"
#include "lambent/sky/preetham.h"

namespace lambent::sky {

/// Luminance in cd m⁻² by direction in the Sun's frame, finite and ≥ 0, from many threads at once;
/// as daylight of chromaticity x, y (D65 unless it says otherwise).
std::shared_ptr<const Dome> daylightDome(std::function<double(const Vec3d&)> luminance,
                                         double x = .3127, double y = .3290);

std::shared_ptr<const Dome> preethamDome(const PreethamSky& sky);

}  // namespace lambent::sky
