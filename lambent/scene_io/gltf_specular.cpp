#include "lambent/scene_io/gltf_specular.h"

#include <algorithm>

#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_material.h"

namespace lambent::scene_io {
namespace {

constexpr float kDielectric = 0.04f, kLeftOut = 0.06f;

Rgb inUnit(const Rgb& color) {
  return color.max(0.0f).min(1.0f);
}

}  // namespace

Rgb reflectanceAtNormal(const nlohmann::json& materialJson, const Rgb& color, double factor) {
  const nlohmann::json* extensions = find(materialJson, "extensions");
  const double ior =
      std::clamp(number(find(extensions, "KHR_materials_ior"), "ior", 1.5), 0.0, 1e3);
  const nlohmann::json* specular = find(extensions, "KHR_materials_specular");
  const double root = (ior - 1.0) / (ior + 1.0);
  const double strength = std::clamp(factor * number(specular, "specularFactor", 1.0), 0.0, 1.0);
  const Rgb tint = color * rgb(specular, "specularColorFactor").value_or(Rgb::Ones());
  return inUnit(float(root * root) * tint.max(0.0f)) * float(strength);
}

Rgb glossyPart(const Rgb& f0) {
  const float most = f0.maxCoeff();
  if (!(most > kLeftOut)) return Rgb::Zero();
  return f0 * ((most - kDielectric) / ((1.0f - kDielectric) * most));
}

void addGlossyPart(const Rgb& glossy, double share, double roughness, const Rgb& textureMean,
                   scene::Material& material) {
  const Rgb part = float(share) * glossy;
  if (!(part.maxCoeff() > 0.0f) || material.isMirror()) return;
  material.diffuse *= 1.0f - part.maxCoeff();
  material.glossy = inUnit(material.glossy + part / textureMean.max(1e-3f));
  material.lobeExponent = lobeExponentFromRoughness(std::clamp(roughness, 0.0, 1.0));
}

SpecularGlossiness specularGlossinessOf(const nlohmann::json& extension) {
  SpecularGlossiness values;
  values.diffuse = inUnit(rgb(&extension, "diffuseFactor").value_or(Rgb::Ones()));
  values.specular = inUnit(rgb(&extension, "specularFactor").value_or(Rgb::Ones()));
  values.glossiness = std::clamp(number(&extension, "glossinessFactor", 1.0), 0.0, 1.0);
  return values;
}

bool isMostlySpecular(const SpecularGlossiness& values, const Rgb& textureMean) {
  const Rgb glossy = glossyPart(values.specular);
  return glossy.sum() > (values.diffuse * textureMean).sum();
}

void applySpecularGlossiness(const SpecularGlossiness& values, const Rgb& textureMean,
                             scene::Material& material) {
  const double roughness = 1.0 - values.glossiness;
  const Rgb glossy = glossyPart(values.specular);
  material.glossy = material.mirror = Rgb::Zero();
  material.diffuse = values.diffuse * (1.0f - values.specular.maxCoeff());
  // As metallic-roughness has it: a metal without roughness.
  if (roughness <= 0.05 && material.diffuse.maxCoeff() < 1e-3f && glossy.maxCoeff() > 0.0f) {
    material.diffuse = Rgb::Zero();
    material.mirror = values.specular;
    return;
  }
  material.matteRoughness = float(roughness);
  material.lobeExponent = lobeExponentFromRoughness(roughness);
  material.glossy = inUnit(glossy / textureMean.max(1e-3f));
}

}  // namespace lambent::scene_io
