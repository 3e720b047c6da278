// Randomness: pieces of the patch laid about centres over a surface, and cut where they look alike.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/synthesis/meso_graph.h"
#include "lambent/synthesis/patch_pieces.h"
#include "lambent/synthesis/similar_places.h"

namespace lambent::synthesis {

struct ScatterOptions {
  Vec2 patchSize = Vec2(0.1f, 0.1f);  ///< metres
  float randomness = 0.5f;            ///< 0 … 1, as in SynthesisOptions: 0 has no cells
  std::uint64_t seed = 0;
  const PatchPieces* pieces = nullptr;  ///< of the patch: cuts go round them where they can
};

/// Cuts what is laid over a level, `q`, into cells about patchSize / (2 · randomness) wide. Each
/// jumps to another place of the patch that looks like what its centre has, and goes on from there
/// as the patch does along the tangent field, beyond its border into its neighbours. Where two
/// overlap, they are cut along where they look most alike and the fewest pieces are parted. Where pieces leave room between them, those that
/// are still parted are made whole or give way to what lies between. `graph` and `patch` are the
/// level's; `coarse` is the patch as a level sees it that can just tell its places apart: there cells
/// look for places alike. The same at any number of threads.
Status scatter(const MesoMesh& mesh, std::size_t level, const MesoGraph& graph,
               const PatchLevel& patch, const PatchLevel& coarse, const ScatterOptions& options,
               const Progress& progress, std::vector<Vec2>& q);

}  // namespace lambent::synthesis
