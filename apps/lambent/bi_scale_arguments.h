// Options of surfaces with meso-structure, which render and shade share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lambent/shade/bi_scale_options.h"

namespace lambent::tool {

struct BiScaleArguments {
  std::string macro = "best";
  bool viewDependent = true, filter = true;

  void addTo(CLI::App& app);
  void addFilterTo(CLI::App& app);
  shade::BiScaleOptions options() const;
};

}  // namespace lambent::tool
