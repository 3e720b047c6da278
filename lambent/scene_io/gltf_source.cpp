#include "lambent/scene_io/gltf_source.h"

#include <algorithm>
#include <array>

#include "lambent/scene_io/gltf_extensions.h"
#include "lambent/scene_io/gltf_json.h"

namespace lambent::scene_io {
namespace {

using nlohmann::json;

bool isTexture(const std::string& key, const json& value) {
  return key.ends_with("Texture") && integer(value, "index").has_value();
}

/// Of every object below, extensions that would not be right in another file.
void stripExtensions(json& value) {
  if (value.is_array()) {
    for (json& each : value) stripExtensions(each);
    return;
  }
  if (!value.is_object()) return;
  for (auto it = value.begin(); it != value.end();) {
    if (it.key() == "extensions") {
      for (auto entry = it->begin(); it->is_object() && entry != it->end();)
        entry = isCarried(entry.key()) && entry->is_object() ? std::next(entry) : it->erase(entry);
      if (it->empty() || !it->is_object()) {
        it = value.erase(it);
        continue;
      }
    }
    if (it.key() != "extras") stripExtensions(*it);
    ++it;
  }
}

json withoutKeys(const json& object, std::initializer_list<const char*> keys) {
  json copy = object.is_object() ? object : json::object();
  for (const char* key : keys) copy.erase(key);
  return copy;
}

/// Names, extras and extensions of meshes and their primitives.
json meshesOf(const json& document) {
  json meshes = json::array();
  const json* given = find(document, "meshes");
  for (std::size_t i = 0; i < arraySize(given); ++i) {
    const json& mesh = (*given)[i];
    json kept = withoutKeys(mesh, {"primitives", "weights"});
    json primitives = json::array();
    const json* parts = find(mesh, "primitives");
    for (std::size_t p = 0; p < arraySize(parts); ++p)
      primitives.push_back(
          withoutKeys((*parts)[p], {"attributes", "indices", "material", "mode", "targets"}));
    kept["primitives"] = std::move(primitives);
    meshes.push_back(std::move(kept));
  }
  return meshes;
}

constexpr std::array kDocumentMembers = {
    "asset",    "scene",      "scenes",   "nodes",      "meshes",         "materials",
    "textures", "images",     "samplers", "cameras",    "accessors",      "bufferViews",
    "buffers",  "animations", "skins",    "extensions", "extensionsUsed", "extensionsRequired",
    "extras"};

void noteMembers(const json& document, Diagnosis& diagnosis) {
  std::uint64_t count = 0;
  std::string first;
  for (const auto& [key, ignored] : document.items()) {
    if (std::find(kDocumentMembers.begin(), kDocumentMembers.end(), key) != kDocumentMembers.end())
      continue;
    if (count++ == 0) first = key.substr(0, 100);
  }
  if (count > 0)
    diagnosis.lose(Severity::Note, "unknown-members", count,
                   "members of the document that glTF does not know are left out: what they say is "
                   "not in the asset; put it into \"extras\"",
                   first);
  if (const std::size_t scenes = arraySize(find(document, "scenes")); scenes > 1)
    diagnosis.lose(Severity::Note, "scenes-ignored", scenes - 1,
                   "more scenes are in the file and are left out: the one that it shows by itself "
                   "is taken; export another one by itself to have that");
}

/// The document without its numbers and without what would not be right elsewhere.
json documentOf(const json& document, const GltfImages& images) {
  json kept = json::object();
  for (const char* key :
       {"asset", "nodes", "materials", "textures", "samplers", "cameras", "extensions", "extras"})
    if (const json* value = find(document, key)) kept[key] = *value;
  const std::int64_t shown = integer(document, "scene").value_or(0);
  const json* scene = element(document, "scenes", shown);
  kept["scene"] = scene != nullptr ? withoutKeys(*scene, {"nodes"}) : json::object();
  kept["meshes"] = meshesOf(document);
  kept["images"] = json::array();
  const json* pictures = find(document, "images");
  for (std::size_t i = 0; i < arraySize(pictures); ++i)
    kept["images"].push_back(withoutKeys((*pictures)[i], {"bufferView", "uri", "mimeType"}));
  json* textures = kept.contains("textures") ? &kept["textures"] : nullptr;
  for (std::size_t i = 0; i < arraySize(textures); ++i) {
    (*textures)[i] = withoutKeys((*textures)[i], {"source"});
    (*textures)[i]["source"] = images.sourceOf(std::int64_t(i));
  }
  stripExtensions(kept);
  return kept;
}

}  // namespace

void eachTexture(json& material, const VisitTexture& visit) {
  if (material.is_array()) {
    for (json& each : material) eachTexture(each, visit);
    return;
  }
  if (!material.is_object()) return;
  for (auto it = material.begin(); it != material.end();) {
    if (isTexture(it.key(), *it) && visit(it.key(), *it) == Place::Goes) {
      it = material.erase(it);
      continue;
    }
    if (it.key() != "extras" && it->is_structured()) eachTexture(*it, visit);
    ++it;
  }
}

bool isBaseColor(const std::string& key) {
  return key == "baseColorTexture" || key == "diffuseTexture";
}

bool isTaken(const std::string& key, const scene::Material& material) {
  return isBaseColor(key) && (key != "diffuseTexture" || material.baseColorTexture >= 0);
}

int texCoordOf(const json& info) {
  const auto set = integer(find(find(info, "extensions"), "KHR_texture_transform"), "texCoord");
  return int(std::clamp<std::int64_t>(set ? *set : integer(info, "texCoord").value_or(0), 0, 1024));
}

std::set<int> otherTexCoords(const json& material) {
  std::set<int> sets;
  json copy = material;
  eachTexture(copy, [&](const std::string& key, json& info) {
    if (!isBaseColor(key)) sets.insert(texCoordOf(info));
    return Place::Stays;
  });
  return sets;
}

Result<std::shared_ptr<scene::Source>> sourceOf(const GltfFile& file,
                                                const std::vector<GltfNode>& nodes,
                                                std::span<const scene::Material> materials,
                                                GltfImages& images, Diagnosis& diagnosis) {
  const json& document = file.json();
  noteMembers(document, diagnosis);
  json kept = documentOf(document, images);
  auto source = std::make_shared<scene::Source>();
  const json* asset = find(document, "asset");
  source->copyright = text(asset, "copyright");
  source->generator = text(asset, "generator");
  source->title = text(find(kept, "scene"), "name");
  if (const json* extras = find(asset, "extras")) {
    const json own = extras->is_object() ? withoutKeys(*extras, {"lambent"}) : *extras;
    if (!own.empty())
      source->assetExtras = own.dump(-1, ' ', false, json::error_handler_t::replace);
  }
  source->materials.assign(materials.begin(), materials.end());

  std::vector<int> placeOf(arraySize(find(document, "nodes")), -1);
  source->nodes.reserve(nodes.size());
  for (const GltfNode& node : nodes) {
    placeOf[std::size_t(node.index)] = int(source->nodes.size());
    const int parent = node.parent < 0 ? -1 : placeOf[std::size_t(node.parent)];
    source->nodes.push_back({int(node.index), parent, node.worldFromNode});
  }

  // Pictures of what light does not ask for: as they are, for others to show.
  source->pictures.resize(arraySize(find(document, "images")));
  json* all = kept.contains("materials") ? &kept["materials"] : nullptr;
  for (std::size_t m = 0; m < arraySize(all); ++m) {
    json& material = (*all)[m];
    std::optional<Error> failed;
    eachTexture(material, [&](const std::string& key, json& info) {
      const bool taken = m < materials.size() && isTaken(key, materials[m]);
      if (taken || failed) return Place::Stays;
      const std::int64_t texture = integer(info, "index").value_or(-1);
      const std::int64_t image = images.sourceOf(texture);
      std::string missing = "there is no such image";
      if (image >= 0 && std::size_t(image) < source->pictures.size()) {
        scene::SourcePicture& picture = source->pictures[std::size_t(image)];
        if (!picture.encoded.empty()) return Place::Stays;
        Result<scene::SourcePicture> found = images.carried(image, missing);
        if (!found) failed = found.error();
        if (!found) return Place::Stays;
        picture = std::move(*found);
        if (!picture.encoded.empty()) return Place::Stays;
      }
      diagnosis.lose(Severity::Warning, "picture-lost", 1,
                     "textures that light does not ask for could not be read, and are not in what "
                     "is written: other viewers show its surfaces without them; put their pictures "
                     "where the file looks for them, as PNG or JPEG",
                     "material " + std::to_string(m) + ", " + key.substr(0, 100) + ": " + missing);
      return Place::Goes;
    });
    if (failed) return *failed;
  }
  source->document = kept.dump(-1, ' ', false, json::error_handler_t::replace);
  const std::uint64_t bytes =
      source->document.size() + source->nodes.size() * sizeof(scene::SourceNode);
  if (Status fits = file.budget().hold(bytes, file.path().string() + ": what it says of itself");
      !fits)
    return fits.error();
  return source;
}

}  // namespace lambent::scene_io
