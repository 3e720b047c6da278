#include "lambent/sky/make_aerial_perspective.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lambent/sky/table_cache.h"

namespace lambent::sky {

namespace {

/// So many over 380 … 740 nm.
std::vector<double> wavelengths(int count) {
  std::vector<double> nm;
  for (int i = 0; i < count; ++i) nm.push_back(380 + i * 360.0 / (count - 1));
  return nm;
}

constexpr int kFew = 16, kMany = 73;

}  // namespace

Result<Scattering> AirMaker::solved(const SkyOptions& options, AerialForm form, Findings& findings,
                                    const Progress& progress) {
  const bool exact = options.model == Model::Exact;
  const std::vector<double> nm = wavelengths(form == AerialForm::Exact ? kMany : kFew);
  Resolution resolution = exact ? Resolution::exact(options.refine) : Resolution::fast();
  const bool anySun = !exact && form != AerialForm::Exact;
  if (!anySun) resolution.lookUpAt(kPi / 2 - options.sunElevation);
  if (kept_ && kept_->atmosphere == options.atmosphere &&
      kept_->scattering.medium().wavelengths == nm && kept_->scattering.resolution() == resolution)
    return kept_->scattering;
  const std::filesystem::path cache = anySun ? options.cache : std::filesystem::path();
  std::optional<Scattering> found = readScattering(cache, options.atmosphere, nm, resolution);
  if (!found) {
    Result<Scattering> made =
        Scattering::solve(mediumOf(options.atmosphere, nm), resolution, progress);
    if (!made) return made.error();
    if (const Status kept = keepScattering(cache, options.atmosphere, *made); !kept)
      findings.push_back({Severity::Note, "air-table-not-kept",
                          fmt::format("the light in this air could not be kept for the next time: "
                                      "{}",
                                      kept.error().message),
                          1});
    found = std::move(*made);
  }
  kept_.emplace(Kept{options.atmosphere, *found});
  return std::move(*found);
}

Result<WithFindings<AerialPerspective>> AirMaker::make(const SkyOptions& options, AerialForm form,
                                                       const Progress& progress) {
  const Atmosphere& atmosphere = options.atmosphere;
  const ViewerInAir viewer{options.altitude, options.sunElevation, options.sunDistance};
  if (Status stands = checkViewer(viewer, {atmosphere.planetRadius, atmosphere.height}); !stands)
    return stands.error();
  Findings findings;
  Result<Scattering> light = solved(options, form, findings, progress);
  if (!light) return light.error();
  switch (form) {
    case AerialForm::Exact:
      return WithFindings<AerialPerspective>{ExactAir(std::move(*light), atmosphere, viewer),
                                             std::move(findings)};
    case AerialForm::Constant:
      return WithFindings<AerialPerspective>{constantAir(*light, atmosphere, viewer),
                                             std::move(findings)};
    case AerialForm::Table:
      break;
  }
  return WithFindings<AerialPerspective>{AirTable(*light, atmosphere, viewer), std::move(findings)};
}

Result<WithFindings<AerialPerspective>> makeAerialPerspective(const SkyOptions& options,
                                                              AerialForm form,
                                                              const Progress& progress) {
  return AirMaker().make(options, form, progress);
}

}  // namespace lambent::sky
