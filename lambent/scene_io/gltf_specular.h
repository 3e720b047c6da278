// What materials reflect apart from their base colour: KHR_materials_specular, KHR_materials_ior and
// KHR_materials_pbrSpecularGlossiness.
//
// A dielectric reflects f0 of the light at normal incidence: ((n − 1)/(n + 1))², 4% of it for most.
// That much is left out, as gltf_material.h says; what reflects s = max(f0) of more than 6% has a
// glossy part f0·(s − 4%)/(96%·s), which begins at nothing and is all of it for a metal.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// f0 by index of refraction, factor and colour. `color` and `factor`: the means of their textures.
Rgb reflectanceAtNormal(const nlohmann::json& materialJson, const Rgb& color, double factor);

/// The glossy part of what reflects f0; zero for common dielectrics.
Rgb glossyPart(const Rgb& f0);

/// Puts a glossy part over `share` of a material, below which its diffuse part has what is left.
/// The material's texture multiplies both and is, in the mean, `textureMean`.
void addGlossyPart(const Rgb& glossy, double share, double roughness, const Rgb& textureMean,
                   scene::Material& material);

struct SpecularGlossiness {
  Rgb diffuse = Rgb::Ones(), specular = Rgb::Ones();
  double glossiness = 1.0;
};
SpecularGlossiness specularGlossinessOf(const nlohmann::json& extension);

/// Whether it is a metal, whose diffuse texture says nothing: `textureMean` is the mean of that.
bool isMostlySpecular(const SpecularGlossiness& values, const Rgb& textureMean);

/// Sets the reflectances and the lobe of `material`.
void applySpecularGlossiness(const SpecularGlossiness& values, const Rgb& textureMean,
                             scene::Material& material);

}  // namespace lambent::scene_io
