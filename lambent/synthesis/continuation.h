// Where a patch goes on over a surface as it does in itself, and where it is torn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/synthesis/patch_look.h"
#include "lambent/synthesis/worn_surface.h"

namespace lambent::synthesis {

struct ContinuationOptions {
  /// How far a place may lie from where its neighbour's continuation has it, in periods (the shorter
  /// of the two); about a position of the patch.
  float tolerance = 1.0f / 48.0f;
  /// … or that share of the way between the two, which is strain, and no tear.
  float strain = 0.4f;
};

/// A run of tears that touch each other.
struct Tear {
  Vec3 middle;          ///< world
  float length = 0.0f;  ///< metres
};

struct Continuation {
  /// For each step, whether the patch goes on over it: as it lies, or as one of its symmetries lies.
  std::vector<std::uint8_t> goesOn;
  double share = 1.0;       ///< of steps, by the width of the line on which texels meet
  double tearLength = 0.0;  ///< metres of tears in all
  std::vector<Tear> tears;  ///< by falling length
};

/// A tear's length is that of the texels' sides that it runs along, times π/4: what a line in any
/// direction has in the mean over its length, by Crofton's formula. `symmetries` as symmetriesOf
/// returns them: with a turn, frames are to be turned as the patch is.
Continuation continuationOf(const WornTexels& texels, const Vec2& period,
                            std::span<const LookSymmetry> symmetries,
                            const ContinuationOptions& options = {});

}  // namespace lambent::synthesis
