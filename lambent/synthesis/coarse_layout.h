// Where on the patch synthesis begins: the coarsest level at which the patch can be told apart.
#pragma once

#include <span>
#include <vector>

#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/similar_places.h"

namespace lambent::synthesis {

struct CoarseLayoutOptions {
  Vec2 patchSize;
  float randomness = 0.0f;  ///< 0 … 1, as in SynthesisOptions
  std::uint64_t seed = 0;
};

/// The place of the patch at each vertex of a level, not wrapped. `offsets` as of offsetsOf.
std::vector<Vec2> coarseLayout(const MesoMesh& mesh, std::size_t level,
                               std::span<const Vec2> offsets, const PatchLevel& patch,
                               const CoarseLayoutOptions& options);

}  // namespace lambent::synthesis
