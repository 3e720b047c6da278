// From what a person says of a sky to what its air does before things.
#pragma once

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/make_sky.h"

namespace lambent::sky {

enum class AerialForm { Exact, Table, Constant };

/// The air of SkyOptions::atmosphere, for its viewer and its Sun, whatever its model: analytic skies
/// know of no distance. Solves the atmosphere about that Sun, with Resolution::exact(refine) for
/// Model::Exact and fast() for all others; of 16 wavelengths, and of 73 for AerialForm::Exact.
/// BadUsage: see checkViewer(); Cancelled.
Result<AerialPerspective> makeAerialPerspective(const SkyOptions& options, AerialForm form,
                                                const Progress& progress = {});

}  // namespace lambent::sky
