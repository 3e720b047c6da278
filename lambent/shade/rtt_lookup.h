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
  /// Whether a view is read where it shows the point that the true ray meets; else all where that
  /// ray meets the plane that positions lie in.
  bool corrected = false;
  /// If so: how far these places are apart for a point as far above that plane as the patch is deep,
  /// periods.
  std::array<Vec2, 4> apart = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

/// Bilinear between the centres of the view samples, constant beyond the outermost. `toViewer`:
/// unit, in the patch's frame; below the horizon counts as at it. Straight above is the centre of
/// the samples. `relief`: as RttPyramid has it, for views that are corrected, or 0.
RttViews viewsAround(int views, const Vec3& toViewer, const Vec2& relief = Vec2::Zero());

/// Σ_i B_i(q, v) l_i, where l holds rttStride(bands) numbers as the pyramid's are laid out. Level 0
/// is read at the nearest position, the others bilinearly between positions, and what lies between
/// two levels is their mix. The views are corrected if they say so and the pyramid has heights.
Rgb respond(const RttPyramid& pyramid, const Vec2& q, const RttProbes& probes,
            const RttViews& views, const float* light);

}  // namespace lambent::shade
