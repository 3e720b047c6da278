// glTF metallic-roughness ⇄ scene::Material.
//
// Read:  diffuse = base·(1 − metallic); glossy = base·metallic with a Phong-like lobe about the
//        mirrored view. The microfacet width is α = roughness²; a Blinn-Phong lobe about the half
//        vector of the same width has the exponent 2/α² − 2 (walter2007microfacet §5.2), and a lobe
//        about the mirrored direction, whose angles are twice as wide, about a quarter of that. It
//        is taken to be 1 at least. metallic ≥ 0.999 with roughness ≤ 0.05 is a mirror.
//        The 4% of light that dielectrics reflect at normal incidence is left out.
// Write: base = diffuse + glossy, metallic = the glossy share of it, roughness by the inverse; the
//        exact values go beside in extras.lambent, and are believed on reading as long as the
//        metallic-roughness values are still the ones that were written with them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lambent/scene/scene.h"

namespace lambent::scene_io {

struct MetallicRoughness {
  Rgb baseColor = Rgb::Ones();
  double metallic = 1.0, roughness = 1.0;
};

float lobeExponentFromRoughness(double roughness);
double roughnessFromLobeExponent(double exponent);

/// Sets the reflectances and the lobe of `material`.
void applyMetallicRoughness(const MetallicRoughness& pbr, scene::Material& material);
MetallicRoughness metallicRoughnessOf(const scene::Material& material);

/// KHR_materials_transmission: of what is diffuse, that share goes on straight through in the base
/// colour; the factor that a material is written with.
void applyTransmission(double share, scene::Material& material);
double transmissionOf(const scene::Material& material);

/// material.extras.lambent, if it is there and still agrees with `pbr`. True if it was used.
bool applyExtras(const nlohmann::json& materialJson, const MetallicRoughness& pbr,
                 scene::Material& material);
nlohmann::json extrasOf(const scene::Material& material);

}  // namespace lambent::scene_io
