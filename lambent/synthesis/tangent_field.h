// A smooth field of tangents over a surface: which way the patch lies.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::synthesis {

struct TangentFieldOptions {
  /// Steering: the field follows this world direction where the surface lets it. None: as smooth as
  /// the surface allows.
  std::optional<Vec3> direction;
  /// How strongly it follows: 0 … 1; 1 projects the direction wherever that is possible.
  float steering = 0.9f;
  /// How many directions, evenly around, are as good as one (N-RoSy, knoppel2013globally §3): 1; 4
  /// for what quarter turns leave as it is.
  int turns = 1;
};

struct TangentField {
  /// One per vertex of the mesh, unit, at right angles to the normal; of several equivalent
  /// directions any one, not the same as its neighbours'.
  std::vector<Vec3> tangents;
  struct Singularity {
    std::uint32_t triangle;
    /// +1 or −1, rarely more; over a closed surface they sum to its Euler characteristic times
    /// TangentFieldOptions::turns.
    int index;
  };
  std::vector<Singularity> singularities;
};

/// Vertices of equal position share one tangent plane (the mean normal) and one tangent, which is
/// then turned into each vertex's own plane: borders of UVs leave no seam. Any mesh will do: open,
/// of several components, of any genus. It is cut along edges of three triangles or more and
/// between triangles wound against each other, which findings tell. BadInput for a mesh without
/// triangles.
Result<WithFindings<TangentField>> tangentField(const scene::Mesh& mesh,
                                                const TangentFieldOptions& options);

}  // namespace lambent::synthesis
