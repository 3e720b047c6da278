// The directional lights of sloan2003biscale §4.2, and eq. (5), which turns what they show into
// harmonics.
#pragma once

#include <vector>

#include "lambent/math/types.h"

namespace lambent::meso {

/// A light at infinity: where it stands, and the solid angle that it speaks for.
struct DirectionalLight {
  Vec3 direction;           ///< unit, towards the light, z > 0
  double solidAngle = 0.0;  ///< da, steradians
};

/// Lights over the upper hemisphere: rings of equal polar angle π/(2·polar), each cut into
/// `azimuth` cells. A light stands where it halves its cell's solid angle, so that the mean cosine
/// of a ring is right to the last digit: irradiance of a level surface under uniform light is
/// exactly π. Solid angles sum to 2π. polar, azimuth ≥ 1. The paper has 8 × 16.
std::vector<DirectionalLight> lightGrid(int polar, int azimuth);

/// y_i(l_k) da(l_k) for every light, [light][bands²]: the weights of eq. (5).
std::vector<double> harmonicWeights(const std::vector<DirectionalLight>& lights, int bands);

}  // namespace lambent::meso
