// Borders between charts made short and smooth.
#pragma once

#include <vector>

#include "lambent/atlas/charts.h"

namespace lambent::atlas {

/// Moves borders over a few triangles so that they become shorter, but for those that lie on
/// creases, which stay. Charts hang together; one that a border's move cuts apart becomes two, and
/// one that was a thin strip may vanish.
std::vector<Chart> smoothBorders(const WeldedSurface& surface, const std::vector<Chart>& charts);

}  // namespace lambent::atlas
