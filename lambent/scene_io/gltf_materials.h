// The materials and base-colour textures of a glTF file, read as primitives ask for them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_images.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

/// How a material looks up its base-colour texture: the UV set, and KHR_texture_transform
/// (uv' = translation · rotation · scale · uv), which the loader bakes into the UVs.
struct TextureUse {
  int texCoord = 0;
  Vec2 offset = Vec2::Zero(), scale = Vec2::Ones();
  float rotation = 0.0f;
  Vec2 apply(const Vec2& uv) const;
  bool moves() const { return !offset.isZero(0.0f) || scale != Vec2::Ones() || rotation != 0.0f; }
};

/// Appends to scene.materials and scene.textures. Scene material i is glTF material i, so that what
/// was written in a sequence is read in it; primitives without a material share one more: grey
/// diffuse, or white where they bring vertex colours. (The specification's default, a white rough
/// metal, is nobody's wish.)
class GltfMaterials {
 public:
  GltfMaterials(const GltfFile& file, scene::Scene& scene, Diagnosis& diagnosis);
  /// Once, before anything is asked for.
  Status read();

  /// The scene material of a primitive.
  Result<int> indexOf(const nlohmann::json& primitive, const std::string& place);
  TextureUse textureUse(int material) const;
  /// Whether a material has another texture than that of its base colour on a TEXCOORD_n.
  bool usesBesides(int material, int texCoord) const;
  GltfImages& images() { return images_; }

 private:
  Status readMaterial(const nlohmann::json& object, int index);
  Status readTransmission(const nlohmann::json& object, const std::string& place,
                          scene::Material& material);
  Status readMetallicRoughness(const nlohmann::json& object, const std::string& place,
                               scene::Material& material);
  /// `info`: the base-colour texture, or null where it is of no use.
  Status readSpecularGlossiness(const nlohmann::json& extension, const std::string& place,
                                const nlohmann::json*& info, scene::Material& material);
  Status addSpecular(const nlohmann::json& object, double share, double roughness,
                     const std::string& place, scene::Material& material);
  /// The picture that `info` of a texture names, or null where it names none.
  Result<GltfPicture*> pictureOf(const nlohmann::json* info);
  static void readAlpha(const nlohmann::json& object, scene::Material& material);
  Result<Rgb> readEmission(const nlohmann::json& object, const std::string& place);
  /// The scene's texture for a glTF texture, or −1 and a Warning.
  Result<int> readTexture(std::int64_t texture);

  const GltfFile& file_;
  scene::Scene& scene_;
  Diagnosis& diagnosis_;
  GltfImages images_;
  std::map<int, TextureUse> uses_;
  std::map<int, std::set<int>> otherTexCoords_;
  std::map<std::int64_t, int> textures_;  ///< scene texture by glTF texture
  std::map<bool, int> defaults_;          ///< scene material by "has vertex colours"
};

}  // namespace lambent::scene_io
