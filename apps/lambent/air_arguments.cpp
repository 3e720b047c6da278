#include "apps/lambent/air_arguments.h"

#include <CLI/CLI.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "apps/lambent/arguments.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

void AirArguments::addTo(CLI::App& app) {
  app.add_flag("--air", wanted,
               "Aerial perspective: what is far away is seen through the air of the light's "
               "sky:…, as dense as at its altitude. The ground of that sky is as far below as the "
               "altitude says or the camera stands above y = 0, whichever is more. Air is lit as "
               "if nothing stood between it and the Sun, unless --shafts says otherwise")
      ->group("Air");
  addNumber(app, "--metres-per-unit", air.metresPerUnit,
            {shade::kLeastMetresPerUnit, shade::kMostMetresPerUnit},
            "Metres in one unit of the scene, for --air")
      ->option_text("METRES")
      ->capture_default_str()
      ->group("Air");
  app.add_flag(
         "--shafts", air.shafts,
         "Shafts of light, for --air: terrain and objects throw the Sun's shadow into the air "
         "as well")
      ->group("Air");
}

Result<std::optional<view::AirShown>> AirArguments::shown(
    const CLI::App& app, const std::optional<view::AirShown>& state) const {
  std::optional<view::AirShown> result = state;
  if (wanted && !result) result.emplace();
  for (const char* option : {"--metres-per-unit", "--shafts"})
    if (!result && app.count(option))
      return badUsage(std::string(option) + " is of the air: give --air too");
  if (app.count("--metres-per-unit")) result->metresPerUnit = air.metresPerUnit;
  if (app.count("--shafts")) result->shafts = air.shafts;
  return result;
}

Result<shade::Air> makeAir(view::AirShown shown, const AirUse& use, Console& console) {
  if (shown.shafts && !use.sun) {
    if (use.shaftsInsisted)
      return badUsage("--shafts: shafts of light take a Sun in the light whose shadows are sharp");
    // What somebody once saved does not stand in the way of a picture of it.
    shown.shafts = false;
    console.warn("no-shafts",
                 "the view's shafts of light are not shown: they take a Sun in the light whose "
                 "shadows are sharp");
  }
  // What was noticed was told when the light was made.
  const auto resolved = sources::resolvedSky(use.shot.source);
  if (!resolved) return badUsage("the air (--air): " + resolved.error().message);
  shade::Air result;
  const auto make = [&](sky::AerialForm form, auto& into) {
    auto made = console.stage("air", [&] {
      return sky::makeAerialPerspective(resolved->value.options, form, console.progress());
    });
    if (!made) return Status(made.error());
    console.report(made->findings);
    using Form = std::remove_cvref_t<decltype(*into)>;
    into = std::make_shared<const Form>(std::get<Form>(std::move(made->value)));
    return Status::ok();
  };
  if (Status s = make(sky::AerialForm::Table, result.table); !s) return s.error();
  if (use.form == sky::AerialForm::Exact)
    if (Status s = make(sky::AerialForm::Exact, result.exact); !s) return s.error();
  result.sunFromAsset = (use.shot.assetFromEnvironment * resolved->value.worldFromSun).transpose();
  result.metresPerUnit = shown.metresPerUnit;
  result.ground = use.shot.worldOrigin;
  if (shown.shafts) result.shafts = shade::Shafts{};
  return result;
}

}  // namespace lambent::tool
