// Captured light by rays on the CPU: for machines without OpenGL, and the oracle of
// lambent/render/gl_capture.
#pragma once

#include "lambent/capture/cube_map.h"
#include "lambent/capture/moving_scene.h"

namespace lambent::reference {

/// Coefficients of the light that arrives at each point: the distant environment where nothing
/// hides it, and the bodies as they stand at `time`.
///
/// The environment is taken as its harmonics, E; its coefficients are exact where nothing is in
/// front of it, since what is projected is the *difference* that bodies make: radiance − E(s) where
/// a body is seen, else zero. `points` and the result are in the frame of an asset, rigidly placed
/// in the world by `worldFromAsset`; `worldLight` is in the world. The result has `bands` bands.
std::vector<sh::RgbCoefficients> captureByRays(const capture::MovingScene& scene, double time,
                                               const sh::RgbCoefficients& worldLight,
                                               const Mat4& worldFromAsset,
                                               std::span<const Vec3> points, int bands,
                                               const capture::CubeSize& shape = {});

}  // namespace lambent::reference
