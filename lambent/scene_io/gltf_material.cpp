#include "lambent/scene_io/gltf_material.h"

#include <algorithm>
#include <cmath>

#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {

float lobeExponentFromRoughness(double roughness) {
  const double alpha = std::max(roughness * roughness, 1e-3);
  const double blinn = 2.0 / (alpha * alpha) - 2.0;
  return float(std::max(0.25 * blinn, 1.0));
}

double roughnessFromLobeExponent(double exponent) {
  const double alpha = std::sqrt(2.0 / (4.0 * std::max(exponent, 0.0) + 2.0));
  return std::sqrt(alpha);
}

void applyMetallicRoughness(const MetallicRoughness& pbr, scene::Material& material) {
  const Rgb base = pbr.baseColor.max(0.0f).min(1.0f);
  const double metallic = std::clamp(pbr.metallic, 0.0, 1.0);
  const double roughness = std::clamp(pbr.roughness, 0.0, 1.0);
  material.diffuse = material.glossy = material.mirror = Rgb::Zero();
  if (metallic >= 0.999 && roughness <= 0.05) {
    material.mirror = base;
    return;
  }
  material.diffuse = base * float(1.0 - metallic);
  material.glossy = base * float(metallic);
  material.lobeExponent = lobeExponentFromRoughness(roughness);
}

MetallicRoughness metallicRoughnessOf(const scene::Material& material) {
  MetallicRoughness pbr;
  if (material.isMirror()) {
    pbr.baseColor = material.mirror.min(1.0f);
    pbr.roughness = 0.0;
    return pbr;
  }
  const Rgb sum = material.diffuse + material.glossy + material.transmitted;
  pbr.baseColor = sum.max(0.0f).min(1.0f);
  pbr.metallic = material.isGlossy() ? double(material.glossy.sum()) / double(sum.sum()) : 0.0;
  pbr.roughness = material.isGlossy() ? roughnessFromLobeExponent(material.lobeExponent) : 1.0;
  return pbr;
}

bool applyExtras(const nlohmann::json& materialJson, const MetallicRoughness& pbr,
                 scene::Material& material) {
  const nlohmann::json* lambent = find(find(materialJson, "extras"), "lambent");
  const auto diffuse = rgb(lambent, "diffuse"), glossy = rgb(lambent, "glossy"),
             mirror = rgb(lambent, "mirror");
  const double exponent = number(lambent, "lobeExponent", -1.0);
  if (!diffuse || !glossy || !mirror || exponent < 0.0 || exponent > 1e9) return false;
  scene::Material exact = material;
  exact.diffuse = diffuse->max(0.0f).min(1.0f);
  exact.glossy = glossy->max(0.0f).min(1.0f);
  exact.mirror = mirror->max(0.0f).min(1.0f);
  exact.lobeExponent = float(exponent);
  exact.transmitted = rgb(lambent, "transmitted").value_or(Rgb::Zero()).max(0.0f).min(1.0f);
  const MetallicRoughness written = metallicRoughnessOf(exact);
  const bool agree = (written.baseColor - pbr.baseColor).abs().maxCoeff() < 1e-4f &&
                     std::abs(written.metallic - pbr.metallic) < 1e-4 &&
                     std::abs(written.roughness - pbr.roughness) < 1e-4;
  if (agree) material = exact;
  return agree;
}

double transmissionOf(const scene::Material& material) {
  const double passed = double(material.transmitted.sum());
  return passed > 0.0 ? passed / (passed + double(material.diffuse.sum())) : 0.0;
}

void applyTransmission(double share, scene::Material& material) {
  const auto passed = float(std::clamp(share, 0.0, 1.0));
  material.transmitted = material.diffuse * passed;
  material.diffuse *= 1.0f - passed;
}

nlohmann::json extrasOf(const scene::Material& material) {
  const auto array = [](const Rgb& c) { return nlohmann::json::array({c.x(), c.y(), c.z()}); };
  nlohmann::json exact = {{"diffuse", array(material.diffuse)},
                          {"glossy", array(material.glossy)},
                          {"mirror", array(material.mirror)},
                          {"lobeExponent", material.lobeExponent}};
  if (material.transmitted.maxCoeff() > 0.0f) exact["transmitted"] = array(material.transmitted);
  return {{"lambent", std::move(exact)}};
}

}  // namespace lambent::scene_io
