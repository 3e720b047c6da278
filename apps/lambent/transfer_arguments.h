// How transfer is simulated: the options that bake and synthesize share.
#pragma once

#include "apps/lambent/arguments.h"
#include "apps/lambent/console.h"
#include "lambent/macro/bake.h"

namespace lambent::tool {

/// unshadowed, shadowed, interreflected.
Choices<transfer::Kind> transferKinds();

struct TransferArguments {
  macro::BakeOptions options;

  /// --transfer, --keep-shadowed, --directions, --bounces, --energy-threshold, --seed,
  /// --hit-memory.
  void addTo(CLI::App& app);
  /// BadUsage where the options contradict each other.
  Status check() const;
  /// The options, with the threads that were asked for.
  macro::BakeOptions chosen(const Console& console) const;
};

}  // namespace lambent::tool
