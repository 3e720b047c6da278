// From what a person says of a sky to what its air does before things.
#pragma once

#include <optional>

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/aerial_table.h"
#include "lambent/sky/make_sky.h"

namespace lambent::sky {

enum class AerialForm { Exact, Table, Constant };

/// The air of SkyOptions::atmosphere, for its viewer and its Sun, whatever its model: analytic skies
/// know of no distance. Solves the atmosphere with Resolution::exact(refine) for Model::Exact and
/// fast() for all others; of 16 wavelengths, and of 73 for AerialForm::Exact.
/// BadUsage: see checkViewer(); Cancelled.
Result<WithFindings<AerialPerspective>> makeAerialPerspective(const SkyOptions& options,
                                                              AerialForm form,
                                                              const Progress& progress = {});

/// Makes airs, one after another: what is solved and the same for the next one is kept. A fast one of
/// 16 wavelengths is solved for every place of the Sun at once, and is kept in SkyOptions::cache too.
class AirMaker {
 public:
  /// As makeAerialPerspective().
  Result<WithFindings<AerialPerspective>> make(const SkyOptions& options, AerialForm form,
                                               const Progress& progress = {});

 private:
  Result<Scattering> solved(const SkyOptions& options, AerialForm form, Findings& findings,
                            const Progress& progress);
  struct Kept {
    Atmosphere atmosphere;
    Scattering scattering;
  };
  std::optional<Kept> kept_;
};

}  // namespace lambent::sky
