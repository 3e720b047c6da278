// Surfaces as artists make them, beside path tracing.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

/// A room with a mirror, a tree with cut-out leaves, a paper lantern, a sail with two sides.
void surfaces(const Studio& studio);

}  // namespace lambent::figures
