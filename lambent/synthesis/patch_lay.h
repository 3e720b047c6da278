// How a patch lies on a surface, as an asset alone tells it: what viewers show to a person who
// wants to see why a pattern runs as it does.
#pragma once

#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::synthesis {

struct PatchLay {
  /// A piece of a line on the surface, with a unit normal of the surface there.
  struct Line {
    Vec3 from, to, normal;
  };
  struct Singularity {
    Vec3 position, normal;
    int index;  ///< in parts of `turns`: 1 of 4 is a quarter; over a closed surface they sum to
                ///< `turns` · its Euler characteristic
  };
  /// Of the patch, by which its direction jumps over cuts: 1 (none), 2 or 4 to the full circle.
  int turns = 1;
  std::vector<Line> field;  ///< strokes along the patch's +x, from their middle both ways
  std::vector<Singularity> singularities;
  std::vector<Line> cuts;  ///< edges of two triangles whose texture coordinates differ there
};

/// `mesh` has normals and UVs, and is as in an asset: vertices that were one are doubled where
/// charts end. `tangents`: unit, +x of the patch at each vertex. Strokes lie at least `spacing`
/// metres (> 0) apart, evenly, and are 0.7 of that long; the same ones on every call.
/// Where tangents jump over a cut by what is no turn, as between charts of a mesh's own UVs, the
/// singularities beside it are those of the nearest turns.
PatchLay patchLay(const scene::Mesh& mesh, std::span<const Vec3> tangents, float spacing);

/// That gives about `strokes` of them on so many square metres.
float strokeSpacing(double area, int strokes);

}  // namespace lambent::synthesis
