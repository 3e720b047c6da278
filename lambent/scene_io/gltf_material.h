// glTF metallic-roughness ⇄ scene::Material.
//
// Read:  diffuse = base·(1 − metallic); glossy = base·metallic with a Phong-like lobe about the
//        mirrored view. The microfacet width is α = roughness²; a Blinn-Phong lobe about the half
//        vector of the same width has the exponent 2/α² − 2 (walter2007microfacet §5.2), and a lobe
//        about the mirrored direction, whose angles are twice as wide, about a quarter of that. It
//        is taken to be 1 at least. metallic ≥ 0.999 with roughness ≤ 0.05 is a mirror.
//        The 4% of light that dielectrics reflect at normal incidence is left out.
// Write: base = diffuse + glossy, metallic = the glossy share of it, roughness by the inverse, or
//        what a source had there. The exact values go beside in extras.lambent, and are believed on
//        reading as long as the metallic-roughness values (the factors alone, whatever textures
//        multiply them) are still the ones that were written with them: those that the exact values
//        come to or, where a source had others, `beside` in the same object.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

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

/// What stands beside exact values: what they come to, or what a source had, which says so.
enum class Beside { Exact, Source };

/// material.extras.lambent, if it is there, of that kind and still agrees with `pbr`: the factors
/// alone beside what a source had, otherwise with textures' means. True if it was used.
bool applyExtras(const nlohmann::json& materialJson, Beside beside, const MetallicRoughness& pbr,
                 scene::Material& material);
/// `beside`: the values that stand in the material, where they are not metallicRoughnessOf(it).
nlohmann::json extrasOf(const scene::Material& material,
                        const std::optional<MetallicRoughness>& beside = {});

bool agree(const MetallicRoughness& a, const MetallicRoughness& b);

}  // namespace lambent::scene_io
