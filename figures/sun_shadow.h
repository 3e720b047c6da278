// Shadows of the Sun: five bands, and sharp ones, against the path tracer by the Sun's elevation.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void sunShadow(const Studio& studio);

}  // namespace lambent::figures
