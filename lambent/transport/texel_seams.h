// Where a smooth surface goes on in another chart of its layout, or in another place of the same:
// both sides of such a seam show the same light, though each looks it up among texels of its own.
#pragma once

#include "lambent/transport/receivers.h"
#include "lambent/transport/row_system.h"

namespace lambent::transport {

/// Texels beside seams are moved as little as makes both sides agree: rows M minimise
///     Σ_s |Σ_i a_i(s) M_i − Σ_j b_j(s) M_j|² + Σ_t λ_t |M_t − M⁰_t|²
/// over places s along all seams, where a and b are the weights of the look-ups from either side,
/// and M⁰ what was simulated or, where the surface has no texel, copied: there λ is next to
/// nothing. So what is the same along a seam stays as it is, and a step of one texel becomes none.
class TexelSeams {
 public:
  /// Edges at which the normals of both sides differ are no seams: light may differ there.
  TexelSeams(const scene::Mesh& mesh, const PlacedReceivers::PerMesh& place);

  bool empty() const { return system_.empty(); }
  /// `rows`: one for each texel of the grid, y·width + x.
  void close(RowsToFill rows) const { system_.solve(rows); }

 private:
  RowSystem system_;
};

}  // namespace lambent::transport
