// Which part of what was simulated relights an asset: the option that render and shade share.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/report/result.h"
#include "lambent/shade/transfer_choice.h"

namespace lambent::tool {

struct ChoiceArguments {
  std::string transfer = "best";

  /// --transfer.
  void addTo(CLI::App& app);
  shade::TransferChoice choice() const;
};

/// BadUsage, with the file's name, where the asset does not hold what was asked for.
Status checkHeld(const asset::Asset& asset, shade::TransferChoice choice,
                 const std::filesystem::path& path);

}  // namespace lambent::tool
