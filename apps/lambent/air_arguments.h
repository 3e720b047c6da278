// The air of the light's sky in a picture.
#pragma once

#include <optional>

#include "apps/lambent/console.h"
#include "apps/lambent/state_arguments.h"
#include "lambent/report/result.h"
#include "lambent/shade/air.h"
#include "lambent/sky/make_aerial_perspective.h"
#include "lambent/view/view_state.h"

namespace CLI {
class App;
}

namespace lambent::tool {

struct AirArguments {
  bool wanted = false;
  view::AirShown air;

  /// --air, --metres-per-unit, --shafts.
  void addTo(CLI::App& app);
  /// What is asked for: by the options and, where they say nothing, by a state. BadUsage: options of
  /// an air that neither asks for.
  Result<std::optional<view::AirShown>> shown(const CLI::App& app,
                                              const std::optional<view::AirShown>& state) const;
};

/// What an air is made for.
struct AirUse {
  const Shot& shot;      ///< of whose light it is
  sky::AerialForm form;  ///< Table, or Exact beside it
  bool sun;              ///< there is one for shafts of light
  bool shaftsInsisted;   ///< they are BadUsage without a Sun, and not left out with a word
};
Result<shade::Air> makeAir(view::AirShown shown, const AirUse& use, Console& console);

}  // namespace lambent::tool
