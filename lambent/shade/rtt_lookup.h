// Reading the radiance transfer texture: B(q, v) of sloan2003biscale eq. 4, applied to light.
#pragma once

#include <array>

#include "lambent/math/types.h"
#include "lambent/shade/rtt_footprint.h"
#include "lambent/shade/rtt_pyramid.h"

namespace lambent::shade {

/// The four views around a direction, and their weights, which sum to 1.
struct RttViews {
  std::array<int, 4> index{};  ///< view y · views + view x
  std::array<float, 4> weight{};
};

/// Bilinear between the centres of the view samples, constant beyond the outermost. `toViewer`:
/// unit, in the patch's frame; below the horizon counts as at it. Straight above is the centre of
/// the samples.
RttViews viewsAround(int views, const Vec3& toViewer);

/// Σ_i B_i(q, v) l_i, where l holds rttStride(bands) numbers as the pyramid's are laid out. Level 0
/// is read at the nearest position, the others bilinearly between positions, and what lies between
/// two levels is their mix.
Rgb respond(const RttPyramid& pyramid, const Vec2& q, const RttProbes& probes,
            const RttViews& views, const float* light);

}  // namespace lambent::shade
