#include "apps/lambent/air_arguments.h"

#include <CLI/CLI.hpp>
#include <utility>
#include <variant>

#include "apps/lambent/arguments.h"
#include "lambent/sky/make_aerial_perspective.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

void AirArguments::addTo(CLI::App& app) {
  CLI::Option* air =
      app.add_flag("--air", wanted,
                   "Aerial perspective: what is far away is seen through the air of the light's "
                   "sky:…, whose altitude is the camera's")
          ->group("Air");
  addNumber(app, "--metres-per-unit", metresPerUnit, {1e-6, 1e6},
            "Metres in one unit of the scene, for --air")
      ->option_text("METRES")
      ->capture_default_str()
      ->needs(air)
      ->group("Air");
  app.add_flag(
         "--shafts", shafts,
         "Shafts of light, for --air: what throws a sharp shadow of the Sun throws it into the "
         "air as well")
      ->needs(air)
      ->group("Air");
}

Result<shade::Air> AirArguments::make(const std::string& source, const Mat3d& assetFromSource,
                                      Console& console) const {
  // What was noticed was told when the light was made.
  const auto resolved = sources::resolvedSky(source);
  if (!resolved) return badUsage("--air: " + resolved.error().message);
  auto air = console.stage("air", [&] {
    return sky::makeAerialPerspective(resolved->value.options, sky::AerialForm::Table,
                                      console.progress());
  });
  if (!air) return air.error();
  shade::Air result;
  result.table = std::make_shared<const sky::AirTable>(std::get<sky::AirTable>(std::move(*air)));
  result.sunFromAsset = (assetFromSource * resolved->value.worldFromSun).transpose();
  result.metresPerUnit = metresPerUnit;
  if (shafts) result.shafts = shade::Shafts{};
  return result;
}

}  // namespace lambent::tool
