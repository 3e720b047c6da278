// The --window of the command line and of a viewer's state: how a light is softened against
// ringing.
#pragma once

#include <string_view>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

struct Windowing {
  /// Auto: the light stays as it is, but glossy lobes are shown softened (shade::Showing::softLobes).
  enum class Kind { None, Auto, Hann, Lanczos, Minimal };
  Kind kind = Kind::None;
  double width = 0.0;  ///< of Hann and Lanczos, in bands, > 0; 0: as many as the light has
};

/// none | auto | minimal | hann | lanczos | hann:WIDTH | lanczos:WIDTH. BadUsage says how it is written.
Result<Windowing> parseWindowing(std::string_view text);

/// Whether such a window is the one that softens lobes, not lights.
bool softensLobes(std::string_view text);

/// What each band of the light is multiplied with (see sh/window.h); all ones for none
/// and auto.
std::vector<double> windowOf(const Windowing& windowing, const sh::RgbCoefficients& light);
/// Multiplies every band of the light (see sh/window.h). A window is the same in every direction,
/// so it does not matter whether a light is turned before or after.
void soften(const Windowing& windowing, sh::RgbCoefficients& light);

}  // namespace lambent::light
