// How an asset is shown: the options that render and shade share.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "lambent/asset/asset.h"
#include "lambent/report/result.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/showing.h"
#include "lambent/view/view_state.h"

namespace lambent::tool {

struct ShowingArguments {
  std::optional<transfer::Kind> transfer;  ///< none: the best that is baked
  std::optional<transfer::Kind> macro;     ///< none: as transfer
  bool viewDependent = true, filter = true;
  std::optional<double> lobeExponent;
  shade::SunShadow sunShadow = shade::SunShadow::Sharp;

  /// --lobe.
  void addLobeTo(CLI::App& app, const char* group);
  /// --transfer, --macro, --view-dependence.
  void addTo(CLI::App& app);
  /// --filter.
  void addFilterTo(CLI::App& app);

  /// --sun-shadow.
  void addSunTo(CLI::App& app);

  shade::Showing showing() const;
  /// What a state says, where no flag of `app` says otherwise.
  shade::Showing showing(const CLI::App& app, view::ViewState state) const;
};

/// BadUsage, with the file's name, where the asset does not hold what was asked for.
Status checkHeld(const asset::Asset& asset, const shade::Showing& showing,
                 const std::filesystem::path& path);

}  // namespace lambent::tool
