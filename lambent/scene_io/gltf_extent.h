// Where the scene of a glTF file lies, before any of it is read as floats of the world.
#pragma once

#include <vector>

#include "lambent/scene_io/far_origin.h"
#include "lambent/scene_io/gltf_nodes.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

/// The origin to move the scene to (see far_origin.h), zero where it is near. Of every mesh that is
/// shown its box, in double through node, instance and joint: the box that its accessor states,
/// and where that would move the scene, the box of its numbers.
Result<Vec3d> farOriginOf(const GltfFile& file, const std::vector<GltfNode>& nodes);

}  // namespace lambent::scene_io
