// The pieces that a patch is made of, pebbles say, and how many of them are whole in a result.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/synthesis/continuation.h"
#include "lambent/synthesis/patch_look.h"
#include "lambent/synthesis/worn_surface.h"

namespace lambent::synthesis {

/// What of a patch stands out from what lies between, seen from above, as pieces that end.
struct PatchPieces {
  static constexpr int kBetween = -1;
  int width = 0, height = 0;
  std::vector<int> pieceAt;   ///< [y][x], finer than the patch's positions
  std::vector<double> areas;  ///< of each piece, as a share of the period's

  /// At the place q (wrapped).
  int at(const Vec2& q) const;
};

/// Two classes by how far the colour of a place is from the patch's most frequent one (Otsu's
/// threshold, otsu1979threshold); pieces are the connected parts of that class which covers more in
/// parts that do not go on without end. Parts are two where a neck between them is narrower than two
/// positions; where two come so near, a little is taken off their rims, which no texel leaps over
/// then. Parts below a twentieth of the largest are specks, and lie between. Empty where they cover
/// less than a quarter of the patch (the holes of a knit), nothing ends, or they would not count as
/// whole on the patch laid flat.
PatchPieces piecesOf(const PatchLook& look);

struct WholePieces {
  /// Share of the pieces' area, on the surface, in connected pieces whose area is within 15% of that
  /// of a piece of the patch.
  double wholeByArea = 1.0;
  /// … and which moreover show one piece of the patch: their largest part over which the patch goes
  /// on is itself as large as that piece, to 15%.
  double whole = 1.0;
  std::size_t count = 0;  ///< connected pieces
};

/// Pieces that the surface's own border cuts are left out. None where the patch has no pieces.
std::optional<WholePieces> wholePieces(const WornTexels& texels, const Vec2& period,
                                       const Continuation& continuation, const PatchPieces& pieces);

}  // namespace lambent::synthesis
