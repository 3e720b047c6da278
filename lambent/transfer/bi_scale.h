// Transfer to surfaces that carry meso-structure: a patch spread over them.
#pragma once

#include <variant>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/transfer/id_map.h"
#include "lambent/transfer/kind.h"
#include "lambent/transfer/receivers.h"
#include "lambent/transfer/surface.h"

namespace lambent::transfer {

/// The mesh's own texture coordinates repeat the patch: q = tiles · (u, −v).
struct Tiles {
  Vec2 tiles = Vec2(1.0f, 1.0f);
};

/// Which patch lies on a surface, and where.
struct Patch {
  int rtt = 0;         ///< index into Field::rtts
  float scale = 1.0f;  ///< metres of the surface that one metre of the patch covers
  std::variant<Tiles, IdMap> place;

  const IdMap* idMap() const { return std::get_if<IdMap>(&place); }
  /// One by one under an id map.
  Vec2 tiles() const {
    const Tiles* repeated = std::get_if<Tiles>(&place);
    return repeated ? repeated->tiles : Vec2(1.0f, 1.0f);
  }
};

/// The matrices yield the light that arrives at the meso-structure, in the tangent frame (tangent,
/// normal × tangent, normal) of each receiver; exit radiance is B(q, v) · (M L)
/// (sloan2003biscale §3, §4.1, eq. 4), times the mesh's base colour: texture and vertex colours
/// are the tint of the patch, which varies its colours over the surface. Without matrices of a kind, light is turned into the frame
/// and nothing hides it: so no matrices are ever held for Kind::Unshadowed. Receivers are vertices.
template <class N>
struct BiScale {
  SharedReceivers receivers;
  std::vector<Vec3> tangents;  ///< world space, unit, at right angles to the normals; per receiver
  Patch patch;                 ///< a bake leaves it to whoever spread the patch
  int bands = 0;               ///< of the matrices, rows and columns alike
  ByKind<Matrices<N>> matrices;  ///< shadowed ones have one channel
};

}  // namespace lambent::transfer
