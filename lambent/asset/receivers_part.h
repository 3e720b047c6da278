// Receivers in a file: vertices are the primitive's own, texels are stored.
#pragma once

#include "lambent/asset/accessors.h"
#include "lambent/asset/part_bytes.h"
#include "lambent/scene/scene.h"
#include "lambent/transfer/receivers.h"

namespace lambent::asset {

/// The member "layout" and, for texels, "grid". Adds the accessors of the grid.
void writeReceivers(const transfer::Receivers& receivers, const scene::Mesh& mesh,
                    scene_io::GltfBuilder& gltf, nlohmann::json& object);
transfer::SharedReceivers receiversFrom(JsonFields& object, AccessorReader& accessors,
                                        const scene::Mesh& mesh);
void count(const transfer::Receivers& receivers, PartBytes& bytes);

}  // namespace lambent::asset
