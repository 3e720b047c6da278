// The macro scale of bi-scale transfer: the light that arrives at the meso-structure of every
// receiver, in its tangent frame.
#pragma once

#include <vector>

#include "lambent/sh/coefficients.h"
#include "lambent/transfer/field.h"

namespace lambent::shade {

/// Columns (tangent, normal × tangent, normal), orthonormal: the tangent is turned into the plane
/// of the unit normal. Any tangent will do where it is parallel to the normal.
Mat3 worldFromPatch(const Vec3& normal, const Vec3& tangent);

/// M L of every receiver under a kind: [receiver][3][bands²], all threads. Unshadowed: the light
/// turned into the tangent frames; another must be held. What the matrices or the light have no
/// bands for is zero.
std::vector<float> incidentLight(const transfer::BiScale<transfer::Numbers>& biScale,
                                 const sh::RgbCoefficients& light, int bands, transfer::Kind kind);

}  // namespace lambent::shade
