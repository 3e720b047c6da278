// A smooth field of tangents over a surface: which way the patch lies.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::synthesis {

/// A direction that the field is to have near a vertex.
struct Guide {
  Vec3 direction = Vec3::Zero();  ///< world space; what of it lies in the surface counts
  float weight = 0.0f;            ///< 0 … 1; 0: no opinion
};

struct TangentFieldOptions {
  /// Steering: the field follows this world direction where the surface lets it. None: as smooth as
  /// the surface allows.
  std::optional<Vec3> direction;
  /// Empty, or one for each vertex: where they weigh, they take the place of `direction`.
  std::vector<Guide> guides = {};
  /// Without a direction: along sharp creases and borders (feature_lines.h) the field follows them
  /// or crosses them at right angles, whichever is nearer to how it would be without. Guides go
  /// first.
  bool align = false;
  /// How strongly it follows direction and guides: 0 … 1; 1 projects them wherever that is possible.
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
  std::uint32_t featureLines = 0;  ///< that there are, if it was to be aligned
  std::uint32_t alignedLines = 0;  ///< of these, where it could decide how to lie
};

/// Vertices of equal position share one tangent plane (the mean normal) and one tangent, which is
/// then turned into each vertex's own plane: borders of UVs leave no seam. Any mesh will do: open,
/// of several components, of any genus. It is cut along edges of three triangles or more and
/// between triangles wound against each other, which findings tell. BadInput for a mesh without
/// triangles.
Result<WithFindings<TangentField>> tangentField(const scene::Mesh& mesh,
                                                const TangentFieldOptions& options);

}  // namespace lambent::synthesis
