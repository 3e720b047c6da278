// How surfaces with meso-structure are shown.
#pragma once

#include <optional>

namespace lambent::shade {

/// What the surface as a whole does to light on its way to the meso-structure (sloan2003biscale
/// Figure 3): nothing, shadows, or shadows and further bounces. Off needs no matrices.
enum class MacroTransport { Off, Shadowed, Interreflected };

struct BiScaleOptions {
  std::optional<MacroTransport> macro;  ///< none: the best that each mesh holds
  /// Off: everywhere as seen from straight above, the centre of the view samples (the one in the
  /// middle or, where their number is even, the mean of the four around it), so that the patch
  /// looks pasted on (sloan2003biscale Figure 6c).
  bool viewDependent = true;
  /// Average the patch over what a sub-sample covers. Off: the nearest position, as
  /// sloan2003biscale §5.
  bool filter = true;
};

}  // namespace lambent::shade
