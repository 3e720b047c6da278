// How many of a patch's pieces are whole in a result.
#pragma once

#include <cstddef>
#include <optional>

#include "lambent/math/types.h"
#include "lambent/synthesis/continuation.h"
#include "lambent/synthesis/patch_pieces.h"
#include "lambent/synthesis/worn_surface.h"

namespace lambent::synthesis {

struct WholePieces {
  /// Share of the pieces' area, on the surface, in connected pieces whose area is within 15% of that
  /// of a piece of the patch.
  double wholeByArea = 1.0;
  /// … that show one piece of the patch, unbroken: measured in the patch, they and their largest part
  /// over which it goes on are as large as that piece, to 15%. A patch that lies larger or smaller
  /// than it is, as a lattice does where a surface has it so, breaks nothing.
  double whole = 1.0;
  std::size_t count = 0;  ///< connected pieces
};

/// Pieces that the surface's own border cuts are left out. None where the patch has no pieces.
std::optional<WholePieces> wholePieces(const WornTexels& texels, const Vec2& period,
                                       const Continuation& continuation, const PatchPieces& pieces);

}  // namespace lambent::synthesis
