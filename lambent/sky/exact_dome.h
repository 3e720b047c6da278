// The sky of a solved atmosphere, marched through for every direction that is asked for.
#pragma once

#include <memory>

#include "lambent/sky/dome.h"
#include "lambent/sky/scattering.h"

namespace lambent::sky {

/// `scattering`: solved at four wavelengths or more. nearness: (1 AU / distance of the Sun)².
std::shared_ptr<const Dome> exactDome(Scattering scattering, const Atmosphere& atmosphere,
                                      double altitude, double sunElevation, double nearness);

}  // namespace lambent::sky
