#include "apps/lambent/bi_scale_arguments.h"

#include "apps/lambent/arguments.h"

namespace lambent::tool {

void BiScaleArguments::addTo(CLI::App& app) {
  app.add_option("--macro", macro,
                 "What the shape as a whole does to light on its way to the meso-structure: off, "
                 "shadowed, interreflected, or the best that is baked")
      ->check(CLI::IsMember({"best", "off", "shadowed", "interreflected"}))
      ->option_text("KIND")
      ->capture_default_str()
      ->group("Meso-structure");
  addChoice(app, "--view-dependence", viewDependent, {{"on", true}, {"off", false}},
            "off: everywhere as seen from straight above, as if pasted on")
      ->option_text("on|off")
      ->group("Meso-structure");
}

void BiScaleArguments::addFilterTo(CLI::App& app) {
  addChoice(app, "--filter", filter, {{"on", true}, {"off", false}},
            "Average the meso-structure over what a sample covers. off: its nearest position")
      ->option_text("on|off")
      ->group("Meso-structure");
}

shade::BiScaleOptions BiScaleArguments::options() const {
  shade::BiScaleOptions result;
  if (macro == "off") result.macro = shade::MacroTransport::Off;
  if (macro == "shadowed") result.macro = shade::MacroTransport::Shadowed;
  if (macro == "interreflected") result.macro = shade::MacroTransport::Interreflected;
  result.viewDependent = viewDependent;
  result.filter = filter;
  return result;
}

}  // namespace lambent::tool
