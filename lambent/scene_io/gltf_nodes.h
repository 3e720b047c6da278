// The nodes of a glTF file's scene: where each stands, which are hidden, and where the instances of
// a mesh are.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include <Eigen/Core>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

struct GltfNode {
  std::int64_t index = 0;
  Eigen::Matrix4d worldFromNode;
  bool hidden = false;       ///< it or one above it, by KHR_node_visibility
  std::int64_t parent = -1;  ///< its index; −1: the scene
};

/// All nodes of the scene that is shown (of the file, if it has no scenes), each after its parent
/// and in the file's sequence. Nodes that form a cycle or share a child are BadInput, and so are
/// transforms that are none; a matrix whose last row is (0, 0, 0, w) but for rounding is divided by
/// w.
Result<std::vector<GltfNode>> nodesOf(const GltfFile& file, Diagnosis& diagnosis);

/// The same by their numbers in the file; null: not in the scene.
std::vector<const GltfNode*> nodesByIndex(const GltfFile& file, const std::vector<GltfNode>& nodes);

/// nodeFromInstance of every instance by EXT_mesh_gpu_instancing; the identity alone where a node
/// has none.
Result<std::vector<Eigen::Matrix4d>> instancesOf(const GltfFile& file, const nlohmann::json& node,
                                                 std::int64_t index, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
