// How good a synthesised texture is, in numbers.
#pragma once

#include <span>

#include "lambent/synthesis/appearance.h"
#include "lambent/synthesis/meso_mesh.h"

namespace lambent::synthesis {

struct SynthesisQuality {
  /// Share of neighbouring vertices that continue each other: the way between their places is the
  /// way over the surface, to half a texel of the patch or 30% of that way.
  double coherent = 0.0;
  /// How unlike a vertex looks from what its neighbours, continued, would have there: the mean
  /// squared distance of descriptors, where 1 is that of places drawn at random and 0 the patch.
  double mismatch = 0.0;
  /// Of 8×8 blocks of the patch, how often the most and the least used one is, where 1 is its share
  /// by area.
  double mostUsed = 0.0, leastUsed = 0.0;
  /// Joints (vertices that continue fewer than half of their neighbours), as a share of vertices…
  double joints = 0.0;
  /// … and how often they lie within 1/16 of the patch's border, where 1 is the share of other
  /// vertices there: far above 1, the patch's own outline shows on the surface.
  double jointsAtBorder = 0.0;
};

/// Of the finest level; `coordinates` as synthesize() returns them for a patch of `patchSize`
/// metres.
SynthesisQuality qualityOf(const MesoMesh& mesh, const Appearance& appearance,
                           const Vec2& patchSize, std::span<const Vec2> coordinates);

}  // namespace lambent::synthesis
