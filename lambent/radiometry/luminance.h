// How bright a colour is.
#pragma once

#include "lambent/math/types.h"

namespace lambent::radiometry {

/// Rec. 709 luminance weights.
float luminance(const Rgb& linear);

}  // namespace lambent::radiometry
