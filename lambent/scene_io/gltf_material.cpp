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
  if (!material.isGlossy()) material.matteRoughness = float(roughness);
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
  pbr.roughness = material.isGlossy() ? roughnessFromLobeExponent(material.lobeExponent)
                                      : double(material.matteRoughness);
  return pbr;
}

namespace {

/// What stood in the material beside the exact values, where they do not say that themselves.
std::optional<MetallicRoughness> besideOf(const nlohmann::json& exact) {
  const nlohmann::json* beside = find(exact, "beside");
  const auto base = rgb(beside, "baseColor");
  if (!base) return {};
  return MetallicRoughness{*base, number(beside, "metallic", 1.0),
                           number(beside, "roughness", 1.0)};
}

}  // namespace

bool applyExtras(const nlohmann::json& materialJson, Beside beside, const MetallicRoughness& pbr,
                 scene::Material& material) {
  const nlohmann::json* lambent = find(find(materialJson, "extras"), "lambent");
  const auto diffuse = rgb(lambent, "diffuse"), glossy = rgb(lambent, "glossy"),
             mirror = rgb(lambent, "mirror");
  const std::optional<MetallicRoughness> source = lambent ? besideOf(*lambent) : std::nullopt;
  if (source.has_value() != (beside == Beside::Source)) return false;
  const double exponent = number(lambent, "lobeExponent", -1.0);
  if (!diffuse || !glossy || !mirror || exponent < 0.0 || exponent > 1e9) return false;
  scene::Material exact = material;
  exact.diffuse = diffuse->max(0.0f).min(1.0f);
  exact.glossy = glossy->max(0.0f).min(1.0f);
  exact.mirror = mirror->max(0.0f).min(1.0f);
  exact.lobeExponent = float(exponent);
  exact.transmitted = rgb(lambent, "transmitted").value_or(Rgb::Zero()).max(0.0f).min(1.0f);
  if (!exact.isGlossy()) exact.matteRoughness = float(std::clamp(pbr.roughness, 0.0, 1.0));
  const MetallicRoughness written = source.value_or(metallicRoughnessOf(exact));
  if (!agree(written, pbr)) return false;
  material = exact;
  return true;
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

bool agree(const MetallicRoughness& a, const MetallicRoughness& b) {
  return (a.baseColor - b.baseColor).abs().maxCoeff() < 1e-4f &&
         std::abs(a.metallic - b.metallic) < 1e-4 && std::abs(a.roughness - b.roughness) < 1e-4;
}

nlohmann::json extrasOf(const scene::Material& material,
                        const std::optional<MetallicRoughness>& beside) {
  const auto array = [](const Rgb& c) { return nlohmann::json::array({c.x(), c.y(), c.z()}); };
  nlohmann::json exact = {{"diffuse", array(material.diffuse)},
                          {"glossy", array(material.glossy)},
                          {"mirror", array(material.mirror)},
                          {"lobeExponent", material.lobeExponent}};
  if (material.transmitted.maxCoeff() > 0.0f) exact["transmitted"] = array(material.transmitted);
  if (beside)
    exact["beside"] = {{"baseColor", array(beside->baseColor)},
                       {"metallic", beside->metallic},
                       {"roughness", beside->roughness}};
  return {{"lambent", std::move(exact)}};
}

}  // namespace lambent::scene_io
