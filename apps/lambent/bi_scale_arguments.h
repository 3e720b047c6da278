// Options of surfaces with meso-structure, which render and shade share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lambent/shade/bi_scale_options.h"

namespace lambent::tool {

struct BiScaleArguments {
  std::string macro = "best";
  std::string viewDependence = "on", filter = "on";

  void addTo(CLI::App& app);
  void addFilterTo(CLI::App& app);
  shade::BiScaleOptions options() const;
};

}  // namespace lambent::tool
