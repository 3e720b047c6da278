// How far baked radiance is from path-traced radiance, vertex by vertex, with the path tracer's own
// noise told apart.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void diffuseAccuracy(const Studio& studio);
void glossyAccuracy(const Studio& studio);

}  // namespace lambent::figures
