#include "apps/lambent/choice_arguments.h"

#include "apps/lambent/arguments.h"

namespace lambent::tool {

void ChoiceArguments::addTo(CLI::App& app) {
  app.add_option(
         "--transfer", transfer,
         "What the light does on its way: unshadowed, shadowed, interreflected (shadows and "
         "bounces), or the best that is baked. Surfaces with meso-structure follow it too, "
         "unless --macro says otherwise")
      ->check(CLI::IsMember({"best", "unshadowed", "shadowed", "interreflected"}))
      ->option_text("KIND")
      ->capture_default_str()
      ->group("Transfer");
}

shade::TransferChoice ChoiceArguments::choice() const {
  return shade::transferChoiceNamed(transfer).value_or(shade::TransferChoice::Best);
}

Status checkHeld(const asset::Asset& asset, shade::TransferChoice choice,
                 const std::filesystem::path& path) {
  const Status status = shade::checkTransfer(asset, choice);
  return status ? status : badUsage(path.string() + ": " + status.error().message);
}

}  // namespace lambent::tool
