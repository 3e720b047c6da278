#include "apps/lambent/showing_arguments.h"

#include "apps/lambent/arguments.h"
#include "lambent/view/placement.h"

namespace lambent::tool {

void ShowingArguments::addLobeTo(CLI::App& app, const char* group) {
  addNumber(app, "--lobe", lobeExponent, kLobeExponents,
            "Exponent of glossy lobes instead of the baked material's")
      ->option_text("EXPONENT")
      ->group(group);
}

namespace {

using transfer::Kind;
using Choice = std::optional<Kind>;

const Choices<bool> kOnOff = {{"on", true}, {"off", false}};

}  // namespace

void ShowingArguments::addTo(CLI::App& app) {
  addChoice(app, "--transfer", transfer,
            {{"best", Choice()},
             {"unshadowed", Kind::Unshadowed},
             {"shadowed", Kind::Shadowed},
             {"interreflected", Kind::Interreflected}},
            "What the light does on its way: unshadowed, shadowed, interreflected (shadows and "
            "bounces), or the best that is baked. Surfaces with meso-structure follow it too, "
            "unless --macro says otherwise")
      ->option_text("KIND")
      ->group("Transfer");
  addChoice(app, "--macro", macro,
            {{"best", Choice()},
             {"off", Kind::Unshadowed},
             {"shadowed", Kind::Shadowed},
             {"interreflected", Kind::Interreflected}},
            "What the shape as a whole does to light on its way to the meso-structure: off, "
            "shadowed, interreflected, or the best that is baked")
      ->option_text("KIND")
      ->group("Meso-structure");
  addChoice(app, "--view-dependence", viewDependent, kOnOff,
            "off: everywhere as seen from straight above, as if pasted on")
      ->option_text("on|off")
      ->group("Meso-structure");
}

void ShowingArguments::addFilterTo(CLI::App& app) {
  addChoice(app, "--filter", filter, kOnOff,
            "Average the meso-structure over what a sample covers. off: its nearest position")
      ->option_text("on|off")
      ->group("Meso-structure");
}

void ShowingArguments::addSunTo(CLI::App& app) {
  addChoice(app, "--sun-shadow", sunShadow,
            {{"sharp", shade::SunShadow::Sharp}, {"soft", shade::SunShadow::Soft}},
            "Shadows that the Sun (the light's brightest disc of 5° or less) throws on diffuse "
            "surfaces: sharp (a shadow map; on the CPU, rays), or soft, as the harmonics have them")
      ->option_text("sharp|soft")
      ->group("Transfer");
}

shade::Showing ShowingArguments::showing() const {
  shade::Showing result = shade::Showing::of(transfer);
  if (macro) result.mesoStructure = macro;
  if (lobeExponent) result.lobeExponent = float(*lobeExponent);
  result.viewDependent = viewDependent;
  result.filter = filter;
  return result;
}

shade::Showing ShowingArguments::showing(const CLI::App& app, view::ViewState state) const {
  const auto given = [&](const char* option) { return app.count(option) > 0; };
  const shade::Showing told = showing();
  if (given("--transfer")) state.transfer = told.surfaces;
  shade::Showing result = view::showingOf(state);
  if (given("--macro")) result.mesoStructure = macro ? macro : result.surfaces;
  if (given("--lobe")) result.lobeExponent = told.lobeExponent;
  if (given("--view-dependence")) result.viewDependent = told.viewDependent;
  result.filter = told.filter;
  return result;
}

Status checkHeld(const asset::Asset& asset, const shade::Showing& showing,
                 const std::filesystem::path& path) {
  const Status status = shade::checkHeld(asset, showing);
  return status ? status : badUsage(path.string() + ": " + status.error().message);
}

}  // namespace lambent::tool
