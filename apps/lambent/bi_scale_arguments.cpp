#include "apps/lambent/bi_scale_arguments.h"

namespace lambent::tool {

void BiScaleArguments::addTo(CLI::App& app) {
  app.add_option("--macro", macro,
                 "What the shape as a whole does to light on its way to the meso-structure: off, "
                 "shadowed, interreflected, or the best that is baked")
      ->check(CLI::IsMember({"best", "off", "shadowed", "interreflected"}))
      ->option_text("KIND")
      ->capture_default_str()
      ->group("Meso-structure");
  app.add_option("--view-dependence", viewDependence,
                 "off: everywhere as seen from straight above, as if pasted on")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off")
      ->capture_default_str()
      ->group("Meso-structure");
}

void BiScaleArguments::addFilterTo(CLI::App& app) {
  app.add_option("--filter", filter,
                 "Average the meso-structure over what a sample covers. off: its nearest position")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off")
      ->capture_default_str()
      ->group("Meso-structure");
}

shade::BiScaleOptions BiScaleArguments::options() const {
  shade::BiScaleOptions result;
  if (macro == "off") result.macro = shade::MacroTransport::Off;
  if (macro == "shadowed") result.macro = shade::MacroTransport::Shadowed;
  if (macro == "interreflected") result.macro = shade::MacroTransport::Interreflected;
  result.viewDependent = viewDependence == "on";
  result.filter = filter == "on";
  return result;
}

}  // namespace lambent::tool
