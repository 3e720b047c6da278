// What the extension asks of the glTF file around it: a scene, nodes that leave the meshes where
// they were baked, and vertices to speak of.
#pragma once

#include "lambent/report/result.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::asset {

/// Of all that the document's scene shows: that its nodes form trees, that none of them moves,
/// deforms or shows twice a mesh with transfer, and that vertices are there and finite. What no
/// scene shows is passed over. Errors name the file and the place in it.
Status checkGltf(const scene_io::GltfFile& file);

}  // namespace lambent::asset
