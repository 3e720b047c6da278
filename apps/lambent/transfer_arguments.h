// How transfer is simulated: the options that bake and synthesize share.
#pragma once

#include <string>

#include "apps/lambent/console.h"
#include "lambent/transport/bake.h"

namespace lambent::tool {

struct TransferArguments {
  transport::BakeOptions options;
  std::string transfer = "interreflected";

  /// --transfer, --keep-shadowed, --directions, --bounces, --energy-threshold, --seed,
  /// --hit-memory.
  void addTo(CLI::App& app);
  /// BadUsage where the options contradict each other.
  Status check() const;
  /// The options, with the kind and the threads that were asked for.
  transport::BakeOptions chosen(const Console& console) const;
};

}  // namespace lambent::tool
