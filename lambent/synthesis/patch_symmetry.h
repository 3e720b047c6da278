// How a patch repeats itself: the translations and the turns that leave it as it looks.
#pragma once

#include <array>

#include "lambent/math/types.h"
#include "lambent/transfer/field.h"

namespace lambent::synthesis {

struct PatchSymmetry {
  /// 4: quarter turns about `centre` leave it as it is, 2: half turns, 1: none.
  int turns = 1;
  Vec2 centre = Vec2::Zero();  ///< a fraction of the period
  /// A shortest basis of the translations that leave it as it is, fractions of its period: the
  /// period itself, (1, 0) and (0, 1), or what it repeats within that, as threads of a weave do.
  std::array<Vec2, 2> lattice = {Vec2(1.0f, 0.0f), Vec2(0.0f, 1.0f)};
  /// Correlation of the patch with itself, −1 … 1: moved by what it resembles itself most by, at a
  /// quarter of the period or more; turned by a half, by a quarter (−1 where its sides differ).
  double moved = -1.0, halfTurned = -1.0, quarterTurned = -1.0;

  /// How often the patch holds what it repeats: 1 or more.
  int cells() const;
  /// It repeats itself within its period, or nearly so.
  bool regular() const { return cells() > 1 || moved >= 0.6; }
};

/// Of the responses seen from above, whose light turns with the patch, to its first three bands.
/// Translations count from a correlation of 0.8, turns from 0.9.
PatchSymmetry symmetryOf(const transfer::SimulatedRtt& rtt);

}  // namespace lambent::synthesis
