#include "apps/lambent/transfer_arguments.h"

#include <CLI/CLI.hpp>

namespace lambent::tool {

Choices<transfer::Kind> transferKinds() {
  using Kind = transfer::Kind;
  return {{"unshadowed", Kind::Unshadowed},
          {"shadowed", Kind::Shadowed},
          {"interreflected", Kind::Interreflected}};
}

void TransferArguments::addTo(CLI::App& app) {
  addChoice(app, "--transfer", options.kind, transferKinds(),
            "unshadowed, shadowed, or interreflected (shadows and bounces)")
      ->option_text("KIND")
      ->group("Transfer");
  app.add_flag("--keep-shadowed", options.keepShadowed,
               "Keep what is shadowed alone beside what is interreflected, so that 'render "
               "--transfer shadowed' and the viewers can show either. A larger asset")
      ->group("Transfer");
  addNumber(app, "--directions", options.directions, {16, 65536},
            "Directions over the whole sphere, the same for every receiver. Twice as many: "
            "twice the time, and a smaller error")
      ->option_text("N")
      ->capture_default_str()
      ->group("Transfer");
  addNumber(app, "--bounces", options.bounces, {0, 1000},
            "Bounces beyond the direct light, at most")
      ->option_text("N")
      ->capture_default_str()
      ->group("Transfer");
  addNumber(app, "--energy-threshold", options.energyThreshold, {0.0, 1.0},
            "Stop bouncing when a pass has less than this fraction of the direct light's "
            "energy, as in 0.001")
      ->option_text("FRACTION")
      ->capture_default_str()
      ->group("Transfer");
  addNumber(app, "--seed", options.seed, kSeeds,
            "Turns the set of directions: two seeds err independently")
      ->option_text("N")
      ->capture_default_str()
      ->group("Transfer");
  addParsed(app, "--hit-memory", options.hitMemory, parseBytes,
            "Memory for remembered hits, as in 2GB; what does not fit is cast again")
      ->option_text("SIZE")
      ->default_str("3GiB")
      ->group("Output");
}

Status TransferArguments::check() const {
  if (options.keepShadowed && options.kind != transfer::Kind::Interreflected)
    return badUsage(
        "--keep-shadowed keeps shadowed transfer beside interreflected: with --transfer " +
        wordOf(options.kind, transferKinds()) + " there is nothing to keep it beside");
  return Status::ok();
}

macro::BakeOptions TransferArguments::chosen(const Console& console) const {
  macro::BakeOptions chosen = options;
  chosen.threads = console.options().threads;
  return chosen;
}

}  // namespace lambent::tool
