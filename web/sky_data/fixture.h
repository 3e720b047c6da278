// Skies of the library as numbers, for the tests of those that hold them in another form.
#pragma once

#include <string>

#include "lambent/report/result.h"

namespace lambent::page {

/// JSON: {"directions": [[x, y, z], …], "skies": [{"model", "turbidity", "sunElevation" (degrees),
/// "sun": [r, g, b] (irradiance), "ground": [r, g, b], "radiance": [[r, g, b], …],
/// "coefficients": [[r, g, b], …]} …]}. In the world, the Sun's bearing 90° (towards +x); radiance
/// is that of the dome and the coefficients, in 5 bands, are those of all.
Result<std::string> skyFixture();

/// JSON: {"directions": [[x, y, z], …] in the Sun's frame, "distances": [m, …], "airs": [{"turbidity",
/// "sunElevation" (degrees), "extinction": [[r, g, b], …], "inScattered": [[r, g, b], …]} …]}: of the
/// library's table, for each direction all distances.
Result<std::string> airFixture();

}  // namespace lambent::page
