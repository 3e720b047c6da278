// The synthesised texture, which lives on the meso-mesh, read out into a map over the atlas.
#pragma once

#include <span>

#include "lambent/atlas/atlas.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/synthesis/lattice_map.h"
#include "lambent/synthesis/meso_mesh.h"
#include "lambent/transfer/id_map.h"

namespace lambent::synthesis {

struct IdMapOptions {
  int size = 2048;                    ///< texels a side
  int neighbours = 20;                ///< k of normal shooting
  Vec2 patchSize = Vec2(0.1f, 0.1f);  ///< metres, as in SynthesisOptions
  int threads = 0;                    ///< 0: all. No effect on the map
};

/// Scan conversion of the atlas, normal shooting to the meso-mesh, and dilation of charts into all
/// texels around them (each continues the patch of the nearest chart texel). A texel's id is that of the
/// meso-vertex it finds, moved on by the texel's own offset from that vertex in the vertex's
/// tangent plane: the map is as smooth as the patch, not as coarse as the meso-mesh.
Result<transfer::IdMap> placeIds(const atlas::Atlas& atlas, const MesoMesh& mesh,
                                 std::span<const Vec2> coordinates, const IdMapOptions& options,
                                 const Progress& progress);

/// The same of a patch that was laid as a lattice: `map` is linear over each of the atlas's
/// triangles, and goes on beyond charts as their nearest triangle has it.
Result<transfer::IdMap> placeIds(const atlas::Atlas& atlas, const LatticeMap& map, int size);

}  // namespace lambent::synthesis
