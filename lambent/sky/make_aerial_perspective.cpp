#include "lambent/sky/make_aerial_perspective.h"

#include <utility>
#include <vector>

namespace lambent::sky {

Result<AerialPerspective> makeAerialPerspective(const SkyOptions& options, AerialForm form,
                                                const Progress& progress) {
  const Atmosphere& atmosphere = options.atmosphere;
  const ViewerInAir viewer{options.altitude, options.sunElevation, options.sunDistance};
  if (Status stands = checkViewer(viewer, {atmosphere.planetRadius, atmosphere.height}); !stands)
    return stands.error();
  std::vector<double> nm;
  const int steps = form == AerialForm::Exact ? 72 : 15;
  for (int i = 0; i <= steps; ++i) nm.push_back(380 + i * 360.0 / steps);
  Resolution resolution =
      options.model == Model::Exact ? Resolution::exact(options.refine) : Resolution::fast();
  resolution.lookUpAt(kPi / 2 - options.sunElevation);
  Result<Scattering> solved = Scattering::solve(mediumOf(atmosphere, nm), resolution, progress);
  if (!solved) return solved.error();
  switch (form) {
    case AerialForm::Exact:
      return AerialPerspective(ExactAir(std::move(*solved), atmosphere, viewer));
    case AerialForm::Constant:
      return AerialPerspective(constantAir(*solved, atmosphere, viewer));
    case AerialForm::Table:
      break;
  }
  return AerialPerspective(AirTable(*solved, atmosphere, viewer));
}

}  // namespace lambent::sky
