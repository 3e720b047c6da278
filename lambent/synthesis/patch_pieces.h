// The pieces that a patch is made of, pebbles say.
#pragma once

#include <vector>

#include "lambent/math/types.h"
#include "lambent/synthesis/patch_look.h"

namespace lambent::synthesis {

/// What of a patch stands out from what lies between, seen from above, as pieces that end.
struct PatchPieces {
  static constexpr int kBetween = -1;
  int width = 0, height = 0;
  std::vector<int> pieceAt;   ///< [y][x], finer than the patch's positions
  std::vector<double> areas;  ///< of each piece, as a share of the period's

  /// At the place q (wrapped).
  int at(const Vec2& q) const;
  double covered() const;  ///< share of the patch
  /// Whether what lies between them is wide enough for cuts to go round them.
  bool leaveRoom() const;
};

/// Two classes by how far the colour of a place is from the patch's most frequent one (Otsu's
/// threshold, otsu1979threshold); pieces are the connected parts of that class which covers more in
/// parts that do not go on without end. Parts are two where a neck between them is narrower than two
/// positions; where two come so near, a little is taken off their rims, which no texel leaps over
/// then. Parts below a twentieth of the largest are specks, and lie between. Empty where they cover
/// less than a quarter of the patch (the holes of a knit), nothing ends, or they would not count as
/// whole on the patch laid flat.
PatchPieces piecesOf(const PatchLook& look);

}  // namespace lambent::synthesis
