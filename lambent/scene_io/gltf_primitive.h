// One primitive of a glTF mesh → a mesh where it was modelled.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_deform.h"
#include "lambent/scene_io/gltf_draco.h"
#include "lambent/scene_io/gltf_materials.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

/// Reads attributes and triangles, compressed by Draco or not. `place` begins messages, after the
/// file's name.
class GltfPrimitive {
 public:
  static Result<GltfPrimitive> open(const GltfFile& file, const nlohmann::json& primitive,
                                    const std::string& place);

  bool has(const std::string& attribute) const;
  /// Positions, normals if there are any, the texture coordinates of `use`, colours and triangles.
  /// Without positions it is empty: nothing to see, says the specification.
  Result<scene::Mesh> mesh(const TextureUse& use) const;

  /// Gives it what else the file has at its vertices: all but what mesh() reads, joints and
  /// weights. `wanted`: whether the coordinates that `use` moves are looked up unmoved, too.
  Status readOthers(const TextureUse& use, bool wanted, scene::Mesh& mesh,
                    Diagnosis& diagnosis) const;

  /// Poses a mesh that mesh() gave. False where the primitive says nothing about joints.
  Result<bool> pose(const GltfSkin& skin, scene::Mesh& mesh) const;

 private:
  GltfPrimitive(const GltfFile& file, const nlohmann::json& primitive, const std::string& place)
      : file_(file), primitive_(primitive), place_(place) {}
  Error bad(const std::string& message) const;
  /// `count` × width numbers.
  Result<std::vector<float>> floats(const std::string& attribute, int width,
                                    std::size_t count) const;
  Result<std::vector<float>> floats(const std::string& attribute, int width) const;
  Result<std::vector<scene::Triangle>> triangles(std::size_t vertices) const;
  Status readColors(scene::Mesh& mesh) const;
  /// Nothing, and `why`, if it cannot be kept.
  Result<std::optional<scene::VertexNumbers>> other(const std::string& name, std::size_t count,
                                                    std::string& why) const;

  const GltfFile& file_;
  const nlohmann::json& primitive_;
  std::string place_;
  std::optional<DracoPrimitive> draco_;
  std::map<std::string, std::int64_t> dracoIds_;  ///< of attributes that Draco holds
};

}  // namespace lambent::scene_io
