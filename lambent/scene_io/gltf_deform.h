// What moves a mesh's vertices in a file: morph targets at the weights that it gives, and a skin
// whose joints stand where its nodes do. Nothing is animated.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_nodes.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

/// The weights that a node (or else its mesh) gives to morph targets; empty: all 0.
std::vector<double> morphWeights(const nlohmann::json& node, const nlohmann::json& mesh);

/// Adds the targets of `primitive`, weighted, to positions and normals.
Status morph(const GltfFile& file, const nlohmann::json& primitive,
             const std::vector<double>& weights, const std::string& place, scene::Mesh& mesh,
             Diagnosis& diagnosis);

/// A skin's joints: worldFromBind of each, as the nodes stand.
class GltfSkin {
 public:
  /// Nothing, and a Warning, where the skin is not whole.
  /// `nodes`: by their numbers (nodesByIndex).
  static Result<std::optional<GltfSkin>> of(const GltfFile& file, std::int64_t skin,
                                            std::span<const GltfNode* const> nodes,
                                            Diagnosis& diagnosis);
  const std::vector<Eigen::Matrix4d>& joints() const { return worldFromBind_; }
  /// Moves `mesh` to where its joints hold it, in world space. `weights` and `joints`: 4·n of each
  /// vertex. False, and nothing is moved, where a joint is referred to that there is not.
  bool pose(std::span<const float> joints, std::span<const float> weights, scene::Mesh& mesh) const;

 private:
  std::vector<Eigen::Matrix4d> worldFromBind_;
};

}  // namespace lambent::scene_io
