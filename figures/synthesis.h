// What texture synthesis makes of patches on surfaces that are hard to cover.
#pragma once

#include "figures/studio.h"

namespace lambent::figures {

/// A sheet for each patch, forms in rows, from afar and near; studio.patches and studio.forms
/// choose among them.
void synthesisSheets(const Studio& studio);

}  // namespace lambent::figures
