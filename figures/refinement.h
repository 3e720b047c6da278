// Error against receivers: triangles cut where shadows fall, and cut everywhere.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void refinement(const Studio& studio);

}  // namespace lambent::figures
