// The macro scale of bi-scale transfer: the light that arrives at the meso-structure of every
// receiver, in its tangent frame.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/encode/encoded_field.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/bi_scale_options.h"

namespace lambent::shade {

/// "off", "shadowed" or "interreflected".
std::string_view nameOf(MacroTransport macro);

bool holds(const encode::EncodedBiScale& biScale, MacroTransport macro);
/// The best that is stored.
MacroTransport bestOf(const encode::EncodedBiScale& biScale);
/// What is stored, as messages list it: "off, shadowed".
std::string heldBy(const encode::EncodedBiScale& biScale);

/// Columns (tangent, normal × tangent, normal), orthonormal: the tangent is turned into the plane
/// of the unit normal. Any tangent will do where it is parallel to the normal.
Mat3 worldFromPatch(const Vec3& normal, const Vec3& tangent);

/// M L of every receiver of a bi-scale mesh: [receiver][3][bands²], all threads. Without transport,
/// the light turned into the tangent frame. `macro` must be held; none: the best that is. What the
/// matrices or the light have no bands for is zero.
std::vector<float> incidentLight(const encode::EncodedMesh& mesh, const sh::RgbCoefficients& light,
                                 int bands, std::optional<MacroTransport> macro);

}  // namespace lambent::shade
