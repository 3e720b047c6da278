#include "lambent/scene_io/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "lambent/radiometry/srgb.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/gltf_source.h"
#include "lambent/scene_io/gltf_specular.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

scene::Wrap wrapOf(std::optional<std::int64_t> code) {
  if (code == 33071) return scene::Wrap::ClampToEdge;
  if (code == 33648) return scene::Wrap::MirroredRepeat;
  return scene::Wrap::Repeat;
}

TextureUse textureUseOf(const json* info) {
  TextureUse use;
  const json* transform = find(find(info, "extensions"), "KHR_texture_transform");
  const auto set = integer(transform, "texCoord");
  use.texCoord =
      int(std::clamp<std::int64_t>(set ? *set : integer(info, "texCoord").value_or(0), 0, 1024));
  if (const auto offset = numbers(transform, "offset", 2)) {
    use.offset = Vec2(float((*offset)[0]), float((*offset)[1]));
  }
  if (const auto scale = numbers(transform, "scale", 2)) {
    use.scale = Vec2(float((*scale)[0]), float((*scale)[1]));
  }
  use.rotation = float(number(transform, "rotation", 0.0));
  return use;
}

}  // namespace

Vec2 TextureUse::apply(const Vec2& uv) const {
  const Vec2 scaled = scale.cwiseProduct(uv);
  if (rotation == 0.0f) return offset + scaled;
  // Counter-clockwise in an image whose v runs downwards: the extension's own matrix.
  const float c = std::cos(rotation), s = std::sin(rotation);
  return offset + Vec2(c * scaled.x() + s * scaled.y(), -s * scaled.x() + c * scaled.y());
}

GltfMaterials::GltfMaterials(const GltfFile& file, scene::Scene& scene, Diagnosis& diagnosis)
    : file_(file), scene_(scene), diagnosis_(diagnosis), images_(file) {}

Status GltfMaterials::read() {
  const json* materials = find(file_.json(), "materials");
  for (std::size_t i = 0; i < arraySize(materials); ++i) {
    if (Status status = readMaterial((*materials)[i], int(i)); !status) return status;
  }
  return Status::ok();
}

Result<int> GltfMaterials::indexOf(const json& primitive, const std::string& place) {
  if (find(primitive, "material") != nullptr) {
    const std::int64_t index = integer(primitive, "material").value_or(-1);
    if (element(file_.json(), "materials", index) == nullptr) {
      return report::badInput(file_.path().string() + ": " + place + " has material " +
                              std::to_string(index) + ", which does not exist");
    }
    return int(index);
  }
  const bool colored = integer(find(primitive, "attributes"), "COLOR_0").has_value();
  const auto [entry, isNew] = defaults_.try_emplace(colored, int(scene_.materials.size()));
  if (isNew) {
    scene::Material material;
    if (colored) material.diffuse = Rgb::Ones();
    scene_.materials.push_back(material);
    diagnosis_.add(Severity::Note, "no-material", 1,
                   colored ? "default material was used: white diffuse under vertex colours"
                           : "default material was used: diffuse grey of 80%",
                   place);
  }
  return entry->second;
}

TextureUse GltfMaterials::textureUse(int material) const {
  const auto it = uses_.find(material);
  return it == uses_.end() ? TextureUse() : it->second;
}

bool GltfMaterials::usesBesides(int material, int texCoord) const {
  const auto it = otherTexCoords_.find(material);
  return it != otherTexCoords_.end() && it->second.contains(texCoord);
}

Status GltfMaterials::readMaterial(const json& object, int index) {
  scene::Material material;
  material.source = index;
  otherTexCoords_[index] = otherTexCoords(object);
  material.name = text(&object, "name");
  material.doubleSided = flag(&object, "doubleSided");
  const std::string place = "material " + std::to_string(index) +
                            (material.name.empty() ? "" : " \"" + material.name + "\"");
  const json* extensions = find(object, "extensions");
  const json* base = find(find(object, "pbrMetallicRoughness"), "baseColorTexture");
  const json* older = find(extensions, "KHR_materials_pbrSpecularGlossiness");
  if (older != nullptr) base = find(older, "diffuseTexture");
  if (Status status = older != nullptr ? readSpecularGlossiness(*older, place, base, material)
                                       : readMetallicRoughness(object, place, material);
      !status) {
    return status;
  }
  if (base != nullptr) {
    uses_[index] = textureUseOf(base);
    const Result<int> texture = readTexture(integer(base, "index").value_or(-1));
    if (!texture) return texture.error();
    material.baseColorTexture = *texture;
  }
  if (find(object, "normalTexture") != nullptr) {
    diagnosis_.lose(
        Severity::Note, "normal-map-ignored", 1,
        "normal maps are ignored: transfer is baked on the mesh itself; what is written "
        "keeps them for other viewers",
        place);
  }
  const Result<Rgb> emission = readEmission(object, place);
  if (!emission) return emission.error();
  material.emission = *emission;
  readAlpha(object, material);
  scene_.materials.push_back(std::move(material));
  return Status::ok();
}

void GltfMaterials::readAlpha(const json& object, scene::Material& material) {
  const std::string mode = text(&object, "alphaMode");
  if (mode != "BLEND" && mode != "MASK") return;
  material.alphaMode = mode == "MASK" ? scene::AlphaMode::Mask : scene::AlphaMode::Blend;
  material.alphaCutoff = float(std::clamp(number(&object, "alphaCutoff", 0.5), 0.0, 1e9));
  const json* older = find(find(object, "extensions"), "KHR_materials_pbrSpecularGlossiness");
  const auto factor = older != nullptr
                          ? numbers(older, "diffuseFactor", 4)
                          : numbers(find(object, "pbrMetallicRoughness"), "baseColorFactor", 4);
  if (factor) material.opacity = float(std::clamp((*factor)[3], 0.0, 1.0));
}

Result<GltfPicture*> GltfMaterials::pictureOf(const json* info) {
  if (info == nullptr) return nullptr;
  return images_.pictureOf(integer(info, "index").value_or(-1));
}

Status GltfMaterials::readMetallicRoughness(const json& object, const std::string& place,
                                            scene::Material& material) {
  const json* pbr = find(object, "pbrMetallicRoughness");
  MetallicRoughness values;
  values.baseColor = rgb(pbr, "baseColorFactor").value_or(Rgb::Ones());
  if (find(find(object, "extensions"), "KHR_materials_unlit") != nullptr) {
    diagnosis_.add(
        Severity::Note, "unlit", 1,
        "materials are unlit: their colour was taken as a diffuse reflectance, and light "
        "that is painted into it is there twice",
        place);
    values.metallic = 0.0;
    applyMetallicRoughness(values, material);
    return Status::ok();
  }
  values.metallic = number(pbr, "metallicFactor", 1.0);
  values.roughness = number(pbr, "roughnessFactor", 1.0);
  // As written beside exact values, before textures multiply it: those need not be looked at.
  if (applyExtras(object, Beside::Source, values, material)) return Status::ok();
  const Result<GltfPicture*> picture = pictureOf(find(pbr, "metallicRoughnessTexture"));
  if (!picture) return picture.error();
  if (*picture != nullptr) {
    values.metallic *= (*picture)->meanChannels[2];
    values.roughness *= (*picture)->meanChannels[1];
    diagnosis_.lose(
        Severity::Note, "mean-metallic-roughness", 1,
        "metallic-roughness textures were replaced by their mean; what is written keeps "
        "them for other viewers",
        place);
  }
  if (applyExtras(object, Beside::Exact, values, material)) return Status::ok();
  applyMetallicRoughness(values, material);
  if (Status status = readTransmission(object, place, material); !status) return status;
  return addSpecular(object, 1.0 - std::clamp(values.metallic, 0.0, 1.0), values.roughness, place,
                     material);
}

/// Of a rough surface too: straight, for want of a lobe that goes through.
Status GltfMaterials::readTransmission(const json& object, const std::string& place,
                                       scene::Material& material) {
  const json* transmission = find(find(object, "extensions"), "KHR_materials_transmission");
  double share = number(transmission, "transmissionFactor", 0.0);
  const Result<GltfPicture*> picture = pictureOf(find(transmission, "transmissionTexture"));
  if (!picture) return picture.error();
  if (*picture != nullptr && share > 0.0) {
    share *= (*picture)->meanChannels[0];
    diagnosis_.lose(
        Severity::Note, "mean-transmission", 1,
        "textures of transmission were replaced by their mean; what is written keeps them "
        "for other viewers",
        place);
  }
  applyTransmission(share, material);
  return Status::ok();
}

Status GltfMaterials::addSpecular(const json& object, double share, double roughness,
                                  const std::string& place, scene::Material& material) {
  const json* specular = find(find(object, "extensions"), "KHR_materials_specular");
  const Result<GltfPicture*> strength = pictureOf(find(specular, "specularTexture"));
  if (!strength) return strength.error();
  const Result<GltfPicture*> color = pictureOf(find(specular, "specularColorTexture"));
  if (!color) return color.error();
  const Rgb glossy = glossyPart(
      reflectanceAtNormal(object, *color != nullptr ? (*color)->meanColor : Rgb(Rgb::Ones()),
                          *strength != nullptr ? (*strength)->meanChannels[3] : 1.0));
  if (!(glossy.maxCoeff() > 0.0f) || !(share > 0.0)) return Status::ok();
  const Result<GltfPicture*> base =
      pictureOf(find(find(object, "pbrMetallicRoughness"), "baseColorTexture"));
  if (!base) return base.error();
  addGlossyPart(glossy, share, roughness, *base != nullptr ? (*base)->meanColor : Rgb(Rgb::Ones()),
                material);
  diagnosis_.add(
      Severity::Note, "glossy-dielectric", 1,
      "materials reflect more light than most do without being metals, and have a glossy "
      "part for it, the same at every angle",
      place);
  return Status::ok();
}

Status GltfMaterials::readSpecularGlossiness(const json& extension, const std::string& place,
                                             const json*& info, scene::Material& material) {
  SpecularGlossiness values = specularGlossinessOf(extension);
  const Result<GltfPicture*> gloss = pictureOf(find(extension, "specularGlossinessTexture"));
  if (!gloss) return gloss.error();
  if (*gloss != nullptr) {
    values.specular *= (*gloss)->meanColor;
    values.glossiness *= (*gloss)->meanChannels[3];
    diagnosis_.lose(
        Severity::Note, "mean-specular-glossiness", 1,
        "specular-glossiness textures were replaced by their mean; what is written keeps "
        "them for other viewers",
        place);
  }
  const Result<GltfPicture*> diffuse = pictureOf(info);
  if (!diffuse) return diffuse.error();
  Rgb mean = *diffuse != nullptr ? (*diffuse)->meanColor : Rgb(Rgb::Ones());
  if (*diffuse != nullptr && isMostlySpecular(values, mean)) {
    diagnosis_.add(
        Severity::Note, "mean-diffuse", 1,
        "materials are mostly specular: the texture of their diffuse part was replaced by "
        "its mean",
        place);
    values.diffuse *= mean;
    mean = Rgb::Ones();
    info = nullptr;
  }
  applySpecularGlossiness(values, mean, material);
  return Status::ok();
}

// Constant over the surface: a texture of it is replaced by its mean.
Result<Rgb> GltfMaterials::readEmission(const json& object, const std::string& place) {
  const auto factor = rgb(&object, "emissiveFactor");
  if (!factor || !(factor->maxCoeff() > 0.0f)) return Rgb(Rgb::Zero());
  Rgb emission = factor->max(0.0f).min(1.0f);
  const json* strength = find(find(object, "extensions"), "KHR_materials_emissive_strength");
  emission *= float(std::clamp(number(strength, "emissiveStrength", 1.0), 0.0, 1e9));
  if (const json* info = find(object, "emissiveTexture")) {
    const auto picture = pictureOf(info);
    if (!picture) return picture.error();
    emission *= (*picture)->meanColor;
    diagnosis_.lose(Severity::Note, "mean-emission", 1,
                    "emissive textures were replaced by their mean; what is written keeps them for "
                    "other viewers",
                    place);
  }
  return emission;
}

Result<int> GltfMaterials::readTexture(std::int64_t index) {
  const auto [entry, isNew] = textures_.try_emplace(index, -1);
  if (!isNew) return entry->second;
  const Result<GltfPicture*> found = images_.pictureOf(index);
  if (!found) return found.error();
  GltfPicture& picture = **found;
  if (!picture.missing.empty()) {
    // A lost picture spoils the colours, not the transfer of light: say so and go on.
    diagnosis_.lose(Severity::Warning, "texture-unreadable", 1,
                    "base-colour textures could not be read; the base-colour factor stands alone",
                    picture.missing);
    return -1;
  }
  const json* object = element(file_.json(), "textures", index);
  const json* sampler = element(file_.json(), "samplers", integer(object, "sampler").value_or(-1));
  scene::Texture texture;
  if (picture.sceneTexture < 0) {
    texture = std::move(picture.texture);
    picture.sceneTexture = int(scene_.textures.size());
  } else {  // the same picture, laid out otherwise
    const scene::Texture& first = scene_.textures[std::size_t(picture.sceneTexture)];
    if (Status fits =
            file_.budget().hold(first.rgba.size() + first.encoded.size(),
                                file_.path().string() + ": texture " + std::to_string(index));
        !fits) {
      return fits.error();
    }
    texture = first;
  }
  texture.name = images_.nameOf(index);
  texture.source = int(index);
  texture.wrapU = wrapOf(integer(sampler, "wrapS"));
  texture.wrapV = wrapOf(integer(sampler, "wrapT"));
  entry->second = int(scene_.textures.size());
  scene_.textures.push_back(std::move(texture));
  return entry->second;
}

}  // namespace lambent::scene_io
