// A patch's texture spread over a surface (turk2001texture, tong2002synthesis, as sloan2003biscale
// §4.3 uses them).
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/synthesis/appearance.h"
#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/patch_pieces.h"

namespace lambent::synthesis {

struct SynthesisOptions {
  Vec2 patchSize = Vec2(0.1f, 0.1f);  ///< metres of the surface that the patch's period covers
  int candidates = 4;                 ///< k of k-coherence
  int passes = 2;                     ///< corrections at each level, four times more at the first
  /// 0 … 1: how far the patch is scattered about. 0 repeats it wherever the surface lets it; else
  /// pieces of about patchSize / (2 · randomness) each show another part of the patch, chosen among
  /// those that look alike: the more random, the less alike.
  float randomness = 0.5f;
  std::uint64_t seed = 0;
  const PatchPieces* pieces = nullptr;  ///< of the patch, to be kept whole
};

/// The place q of the patch at every vertex of the meso-mesh, as a fraction of its period, in
/// [0, 1)². The patch's +x lies along the vertex's tangent, its +y along normal × tangent; where
/// the tangent field turns the patch is stretched or sheared by up to 30%, and torn beyond. The
/// same at any number of threads. BadUsage where fewer than four vertices lie along a period; the
/// message says how many vertices or how large a patch would do.
Result<std::vector<Vec2>> synthesize(const MesoMesh& mesh, const Appearance& appearance,
                                     const SynthesisOptions& options, const Progress& progress);

}  // namespace lambent::synthesis
