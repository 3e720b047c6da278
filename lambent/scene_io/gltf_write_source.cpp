#include "lambent/scene_io/gltf_write_source.h"

#include <string>

#include "lambent/file/json.h"
#include "lambent/scene_io/gltf_extensions.h"
#include "lambent/scene_io/gltf_json.h"
#include "lambent/scene_io/gltf_material.h"
#include "lambent/scene_io/gltf_origin.h"
#include "lambent/scene_io/gltf_source.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

const std::string kVariants = "KHR_materials_variants";
const std::string kOlder = "KHR_materials_pbrSpecularGlossiness";

json parsed(const std::string& text) {
  json document = json::parse(text, nullptr, false);
  return document.is_object() ? std::move(document) : json::object();
}

std::vector<std::set<int>> wantedSets(const json& from) {
  std::vector<std::set<int>> wanted;
  const json* materials = find(from, "materials");
  for (std::size_t i = 0; i < arraySize(materials); ++i)
    wanted.push_back(otherTexCoords((*materials)[i]));
  return wanted;
}

std::set<int> allOf(const std::vector<std::set<int>>& sets) {
  std::set<int> all;
  for (const std::set<int>& each : sets) all.insert(each.begin(), each.end());
  return all;
}

/// Puts what is Lambent's beside what extras there are. Those that are no object stand below.
void putExtras(json& object, json lambent) {
  json extras = object.contains("extras") ? std::move(object["extras"]) : json::object();
  if (!extras.is_object()) extras = {{"extras", std::move(extras)}};
  extras["lambent"] = std::move(lambent);
  object["extras"] = std::move(extras);
}

bool reflectsAlike(const scene::Material& a, const scene::Material& b) {
  const auto same = [](const Rgb& x, const Rgb& y) { return (x == y).all(); };
  return same(a.diffuse, b.diffuse) && same(a.glossy, b.glossy) && same(a.mirror, b.mirror) &&
         same(a.transmitted, b.transmitted) && (!a.isGlossy() || a.lobeExponent == b.lobeExponent);
}

/// A member of `plain`, or none.
void take(const char* key, const json& plain, json& material) {
  if (const json* value = find(plain, key))
    material[key] = *value;
  else
    material.erase(key);
}

void takeExtension(const char* name, const json& plain, json& material) {
  if (const json* value = find(find(plain, "extensions"), name))
    file::objectAt(material, "extensions")[name] = *value;
}

/// All that extensions say of how it reflects.
void dropReflection(json& material) {
  json* extensions = material.contains("extensions") ? &material["extensions"] : nullptr;
  if (extensions == nullptr || !extensions->is_object()) return;
  for (auto it = extensions->begin(); it != extensions->end();)
    it = it.key().find("_materials_") != std::string::npos &&
                 it.key() != "KHR_materials_emissive_strength"
             ? extensions->erase(it)
             : std::next(it);
}

void dropExtension(const char* name, json& object) {
  if (json* extensions = object.contains("extensions") ? &object["extensions"] : nullptr) {
    if (extensions->is_object()) extensions->erase(name);
    if (extensions->empty()) object.erase("extensions");
  }
}

}  // namespace

SourceWriter::SourceWriter(const scene::Scene& scene, json& document, AddPicture addPicture)
    : scene_(scene),
      source_(*scene.source),
      document_(document),
      addPicture_(std::move(addPicture)),
      from_(parsed(scene.source->document)),
      wanted_(wantedSets(from_)),
      slots_(scene, allOf(wanted_)) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (const int source = scene.materials[m].source; source >= 0)
      materialAt_.try_emplace(source, int(m));
}

const json* SourceWriter::fromList(const char* list, int index) const {
  const json* object = element(from_, list, index);
  return object != nullptr && object->is_object() ? object : nullptr;
}

void SourceWriter::writeHead() {
  json asset = from_.contains("asset") ? from_["asset"] : json::object();
  asset["version"] = "2.0";
  const std::string& before = source_.generator;
  asset["generator"] = before.empty()                  ? "Lambent"
                       : before.starts_with("Lambent") ? before
                                                       : "Lambent (from: " + before + ")";
  if (json* extras = asset.contains("extras") ? &asset["extras"] : nullptr)
    if (extras->is_object() && extras->erase("lambent") > 0 && extras->empty())
      asset.erase("extras");
  document_["asset"] = std::move(asset);
  for (const char* key : {"extensions", "extras"})
    if (from_.contains(key)) document_[key] = from_[key];
  json& scene = document_["scenes"][0];
  if (const json* head = find(from_, "scene"); head != nullptr && head->is_object()) scene = *head;
  if (json* extras = scene.contains("extras") ? &scene["extras"] : nullptr)
    if (extras->is_object() && extras->erase("lambent") > 0 && extras->empty())
      scene.erase("extras");
  if (!scene_.origin.isZero(0.0))
    putExtras(scene, std::move(originExtras(scene_.origin)["lambent"]));
}

int SourceWriter::samplerOf(const json& texture) {
  const int sampler = int(integer(texture, "sampler").value_or(-1));
  const json* object = fromList("samplers", sampler);
  if (object == nullptr) return -1;
  const auto [known, isNew] = samplers_.try_emplace(sampler, -1);
  if (isNew) {
    json& list = file::arrayAt(document_, "samplers");
    known->second = int(list.size());
    list.push_back(*object);
  }
  return known->second;
}

void SourceWriter::dressTexture(const scene::Texture& texture, json& imageJson, json& textureJson) {
  const json* before = fromList("textures", texture.source);
  if (before == nullptr) return;
  if (const json* image = fromList("images", int(integer(*before, "source").value_or(-1))))
    for (const auto& [key, value] : image->items()) imageJson[key] = value;
  const auto place = textureJson["source"];
  textureJson = *before;
  textureJson["source"] = place;
  textureJson.erase("sampler");
  if (const int sampler = samplerOf(*before); sampler >= 0) textureJson["sampler"] = sampler;
}

void SourceWriter::note(const scene::Texture& texture, int image) {
  const json* before = fromList("textures", texture.source);
  if (before == nullptr) return;
  textures_.try_emplace(texture.source, int(document_["textures"].size()) - 1);
  images_.try_emplace(int(integer(*before, "source").value_or(-1)), image);
}

int SourceWriter::textureOf(int sourceTexture) {
  if (const auto known = textures_.find(sourceTexture); known != textures_.end())
    return known->second;
  const json* before = fromList("textures", sourceTexture);
  if (before == nullptr) return -1;
  const int image = int(integer(*before, "source").value_or(-1));
  const auto [known, isNew] = images_.try_emplace(image, -1);
  if (isNew) {
    if (image < 0 || std::size_t(image) >= source_.pictures.size()) return -1;
    const scene::SourcePicture& picture = source_.pictures[std::size_t(image)];
    if (picture.encoded.empty()) return -1;
    const json* head = fromList("images", image);
    json object = head != nullptr ? *head : json::object();
    object["bufferView"] = addPicture_(picture.encoded);
    object["mimeType"] = picture.mimeType;
    json& list = file::arrayAt(document_, "images");
    known->second = int(list.size());
    list.push_back(std::move(object));
  }
  if (known->second < 0) return -1;
  json texture = *before;
  texture["source"] = known->second;
  texture.erase("sampler");
  if (const int sampler = samplerOf(*before); sampler >= 0) texture["sampler"] = sampler;
  json& list = file::arrayAt(document_, "textures");
  textures_[sourceTexture] = int(list.size());
  list.push_back(std::move(texture));
  return textures_[sourceTexture];
}

json SourceWriter::material(const scene::Material& now, const json& plain) {
  const json* before = fromList("materials", now.source);
  if (before == nullptr || std::size_t(now.source) >= source_.materials.size()) return plain;
  const scene::Material& read = source_.materials[std::size_t(now.source)];
  json material = *before;
  if (!material.contains("pbrMetallicRoughness") || !material["pbrMetallicRoughness"].is_object())
    material["pbrMetallicRoughness"] = json::object();
  const bool alike = reflectsAlike(now, read);
  if (!alike) {
    dropReflection(material);
    takeExtension("KHR_materials_transmission", plain, material);
  }
  // Others read the older model as little as they can: beside it stands what it comes to.
  const bool older = find(find(material, "extensions"), kOlder) != nullptr;
  if (!alike || older) material["pbrMetallicRoughness"] = plain.at("pbrMetallicRoughness");
  json& pbr = material["pbrMetallicRoughness"];
  const bool mapped = pbr.contains("metallicRoughnessTexture");
  eachTexture(material, [&](const std::string& key, json& info) {
    int index = now.baseColorTexture, set = 0;
    if (!isTaken(key, now)) {
      index = textureOf(int(integer(info, "index").value_or(-1)));
      set = slots_.slotOf(texCoordOf(info));
    } else {
      dropExtension("KHR_texture_transform", info);  // it is in the coordinates
    }
    if (index < 0) return Place::Goes;
    info["index"] = index;
    if (json* moved = info.contains("extensions") ? &info["extensions"] : nullptr)
      if (moved->contains("KHR_texture_transform"))
        (*moved)["KHR_texture_transform"].erase("texCoord");
    info.erase("texCoord");
    if (set > 0) info["texCoord"] = set;
    return Place::Stays;
  });
  if (mapped && !pbr.contains("metallicRoughnessTexture"))
    for (const char* key : {"metallicFactor", "roughnessFactor"})
      pbr[key] = plain["pbrMetallicRoughness"][key];
  if (now.name != read.name) take("name", plain, material);
  if (now.doubleSided || material.contains("doubleSided"))
    material["doubleSided"] = now.doubleSided;
  if (now.alphaMode != read.alphaMode || now.alphaCutoff != read.alphaCutoff)
    for (const char* key : {"alphaMode", "alphaCutoff"}) take(key, plain, material);
  if ((now.emission != read.emission).any()) {
    material.erase("emissiveTexture");
    take("emissiveFactor", plain, material);
    dropExtension("KHR_materials_emissive_strength", material);
    takeExtension("KHR_materials_emissive_strength", plain, material);
  }
  if (find(material, "extensions") != nullptr && material["extensions"].empty())
    material.erase("extensions");
  const MetallicRoughness beside{rgb(&pbr, "baseColorFactor").value_or(Rgb::Ones()),
                                 number(&pbr, "metallicFactor", 1.0),
                                 number(&pbr, "roughnessFactor", 1.0)};
  const bool says =
      !pbr.contains("metallicRoughnessTexture") && agree(metallicRoughnessOf(now), beside);
  putExtras(material,
            std::move(extrasOf(now, says ? std::nullopt : std::optional(beside))["lambent"]));
  return material;
}

std::vector<UvSlot> SourceWriter::uvSlotsOf(const scene::Mesh& mesh) const {
  std::set<int> wanted;
  const auto want = [&](std::int64_t material) {
    if (material < 0 || std::uint64_t(material) >= wanted_.size()) return;
    const std::set<int>& sets = wanted_[std::size_t(material)];
    wanted.insert(sets.begin(), sets.end());
  };
  want(scene::materialOf(scene_, mesh).source);
  const json* before = fromList("meshes", mesh.source.mesh);
  const json* part = before ? element(*before, "primitives", mesh.source.primitive) : nullptr;
  const json* mappings = find(find(find(part, "extensions"), kVariants), "mappings");
  for (std::size_t i = 0; i < arraySize(mappings); ++i)
    want(integer((*mappings)[i], "material").value_or(-1));
  // Another set in the place of the one that is missing would be where its texture is looked up.
  if (mesh.uvs.empty() && scene::materialOf(scene_, mesh).baseColorTexture >= 0) return {};
  return slots_.of(mesh, wanted);
}

void SourceWriter::dressMesh(const scene::Mesh& mesh, json& meshJson) const {
  const json* before = fromList("meshes", mesh.source.mesh);
  if (before == nullptr) return;
  for (const auto& [key, value] : before->items())
    if (key != "primitives") meshJson[key] = value;
  if (!before->contains("name")) meshJson.erase("name");
  const json* part = element(*before, "primitives", mesh.source.primitive);
  if (part == nullptr) return;
  json& primitive = meshJson["primitives"][0];
  for (const auto& [key, value] : part->items()) primitive[key] = value;
  if (find(find(primitive, "extensions"), kVariants) == nullptr) return;
  // Materials by the numbers that they have now.
  json& mappings = primitive["extensions"][kVariants]["mappings"];
  const bool own = scene::materialOf(scene_, mesh).source >= 0;
  json kept = json::array();
  for (std::size_t i = 0; own && i < arraySize(&mappings); ++i) {
    const auto now = materialAt_.find(int(integer(mappings[i], "material").value_or(-1)));
    if (now == materialAt_.end()) continue;
    mappings[i]["material"] = now->second;
    kept.push_back(mappings[i]);
  }
  if (kept.empty())
    dropExtension(kVariants.c_str(), primitive);
  else
    mappings = std::move(kept);
}

void SourceWriter::declareExtensions() {
  json used = json::array();
  for (const auto& [name, ignored] : extensionsIn(document_)) used.push_back(name);
  if (used.empty())
    document_.erase("extensionsUsed");
  else
    document_["extensionsUsed"] = std::move(used);
}

}  // namespace lambent::scene_io
