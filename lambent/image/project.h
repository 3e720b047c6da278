// Pictures of all directions → spherical harmonics.
#pragma once

#include "lambent/image/image.h"
#include "lambent/image/maps.h"
#include "lambent/sh/coefficients.h"

namespace lambent::image {

/// L_i = ∫ L(s) y_i(s) ds as the sum over pixels of value · y_i(pixel centre) · solid angle: exact
/// for a constant picture, and for a picture of m pixels from pole to pole good to about
/// (π l/m)²/24 in band l. Bands 1 … 32. World directions go into the harmonics as they are: the
/// harmonics' polar axis is the world's z, the picture's is y. Asserts on a shape that checkShape
/// refuses; a pixel that is not finite spoils the result (see repair.h). Sums are in double
/// precision and have the same bytes whatever the number of threads.
sh::RgbCoefficients project(const Image& map, MapKind kind, int bands);

}  // namespace lambent::image
