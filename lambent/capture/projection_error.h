// How good the projection of a cube's pictures is (the two analyses of sloan2002precomputed §6.2).
#pragma once

#include "lambent/capture/cube_map.h"

namespace lambent::capture {

/// Squared errors over functions whose square integrates to 1.
struct ProjectionError {
  double average = 0, worst = 0;
};

/// Functions of `bands` bands, sampled at the middle of each sub-texel, averaged over texels and
/// projected, against the functions themselves.
ProjectionError projectionError(const CubeSize& shape, int bands,
                                SolidAngles angles = SolidAngles::Exact);

/// What lies between the samples of a 6×size×size cube: bilinear on each face, constant beyond the
/// outermost middles of texels.
struct BilinearErrors {
  /// Functions of `bands` bands, sampled; their projection from the samples by differential solid
  /// angles against the exact projection of the bilinear function.
  ProjectionError projected;
  /// The same functions; the bilinear function itself against the sampled one, over the sphere.
  ProjectionError reconstructed;
};
BilinearErrors bilinearErrors(int size, int bands);

}  // namespace lambent::capture
