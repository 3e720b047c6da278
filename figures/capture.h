// Captured light: how good cube maps are, and how many points light should be sampled at
// (sloan2002precomputed §6.1-6.2, Figure 5).
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

void captureProjection(const Studio& studio);
void captureFigure5(const Studio& studio);

}  // namespace lambent::figures
