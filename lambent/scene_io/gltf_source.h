// What of a glTF file a scene keeps beside what light asks for (scene/source.h), and the places in
// its materials that textures stand at.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/source.h"
#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_images.h"
#include "lambent/scene_io/gltf_nodes.h"

namespace lambent::scene_io {

/// What a visitor says of a texture's place.
enum class Place { Stays, Goes };
/// `key`: of the place, as "normalTexture"; `info` has an integer `index`.
using VisitTexture = std::function<Place(const std::string& key, nlohmann::json& info)>;

/// Every place of a texture in a material and its extensions, known or not: an object with an index
/// at a key that ends in "Texture". Not in its extras.
void eachTexture(nlohmann::json& material, const VisitTexture& visit);

/// The place of the texture that a scene has as the base colour: in pbrMetallicRoughness, or of the
/// diffuse part of KHR_materials_pbrSpecularGlossiness, beside which the former is not looked at.
bool isBaseColor(const std::string& key);
/// Whether that place is taken by the texture of `material`; the diffuse part may have been taken
/// by its mean, and keeps its texture for others.
bool isTaken(const std::string& key, const scene::Material& material);

/// The TEXCOORD_n that a texture is looked up with.
int texCoordOf(const nlohmann::json& info);

/// The sets of texture coordinates of a material but for that of its base colour.
std::set<int> otherTexCoords(const nlohmann::json& material);

/// `materials`: of the document, in its sequence, as they were read. What is lost besides goes into
/// `diagnosis`.
Result<std::shared_ptr<scene::Source>> sourceOf(const GltfFile& file,
                                                const std::vector<GltfNode>& nodes,
                                                std::span<const scene::Material> materials,
                                                GltfImages& images, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
