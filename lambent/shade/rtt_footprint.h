// How much of a patch a sub-sample of a picture stands for, and the reads of the pyramid that
// average about as much. shaders/rtt_footprint.glsl is the same in GLSL; tests/shaders holds the two
// together.
#pragma once

#include "lambent/math/types.h"
#include "lambent/scene/camera.h"

namespace lambent::shade {

/// The width that a sub-sample of a picture sees, across its ray: metres, growing with the distance
/// (perspective) or not (orthographic).
struct SampleWidth {
  float perMetre = 0.0f, constant = 0.0f;
  float at(float distance) const { return perMetre * distance + constant; }
};

/// A pixel's width, shared among the samples that fill its square: 1/√samples of it each.
SampleWidth sampleWidth(const scene::Camera& camera, int pixelHeight, int samples);

/// The two axes of what a sub-sample sees of a surface: metres, world space.
struct FootprintAxes {
  Vec3 longer, shorter;
};

/// worldFromPatch: the frame at the place; toViewer: unit, in it. As long as 1/cos θ allows, with
/// cos θ no less than kLeastCosine: at the horizon a surface is infinitely long.
FootprintAxes footprintAxes(const Mat3& worldFromPatch, const Vec3& toViewer, float width);

inline constexpr float kLeastCosine = 1.0f / 64.0f;

/// The places of the patch where a sub-sample reads, and the level that it reads there.
struct RttProbes {
  float level = 0.0f;  ///< 0: the texture itself, position for position
  /// Level 0 between its positions: 1 bilinear, 0 the nearest, else between the two.
  float between = 0.0f;
  int count = 1;             ///< evenly spread about the sub-sample's own place …
  Vec2 step = Vec2::Zero();  ///< … this far apart: q, periods of the patch
};

/// For an oblique plane at one sample a pixel, RMSE against 256 was 0.047 unfiltered and 0.030,
/// 0.021, 0.016, 0.014 with 1, 2, 4, 8 probes. Finer levels (a bias of −½, −1) gained at most a
/// tenth there, lost as much on a distant ball, and crawled more.
inline constexpr int kMostProbes = 4;

/// `longer` and `shorter`: the two axes of the footprint on the surface, as they lie in the patch
/// (q, periods of the patch); positions: of level 0, along x and y.
RttProbes probesOf(const Vec2& longer, const Vec2& shorter, const Vec2& positions);

}  // namespace lambent::shade
