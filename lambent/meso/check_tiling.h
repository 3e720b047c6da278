// Whether a patch that came from a file repeats itself without a seam.
#pragma once

#include "lambent/meso/height_field.h"
#include "lambent/meso/patch.h"
#include "lambent/report/finding.h"

namespace lambent::meso {

/// A warning "height-field-seam" for each axis along which heights jump across the border by more
/// than three times what neighbouring samples inside differ by (both as root mean squares); it says
/// by how much, where it is worst, and what helps. Empty: no seam to be seen.
Findings checkTiling(const HeightField& field);

/// A warning "mesh-seam" for each axis along which open edges at one side of the geometry's
/// bounding box have no partner a period further on, within a thousandth of the period. Geometry
/// without open edges (closed threads that end inside of the period, a plane of pebbles) has none.
Findings checkTiling(const Patch& patch);

}  // namespace lambent::meso
