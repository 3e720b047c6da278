// The air of the light's sky in a picture.
#pragma once

#include "apps/lambent/console.h"
#include "lambent/math/types.h"
#include "lambent/report/result.h"
#include "lambent/shade/air.h"

namespace CLI {
class App;
}

namespace lambent::tool {

struct AirArguments {
  bool wanted = false;
  double metresPerUnit = 1;
  bool shafts = false;

  /// --air, --metres-per-unit, --shafts.
  void addTo(CLI::App& app);
  /// The air of the sky in a SOURCE whose light was turned by `assetFromSource`.
  Result<shade::Air> make(const std::string& source, const Mat3d& assetFromSource,
                          Console& console) const;
};

}  // namespace lambent::tool
