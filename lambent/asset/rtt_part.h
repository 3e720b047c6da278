// Radiance transfer textures in a file: to JSON, from JSON, what is wrong with them, their bytes.
// Shared by assets, where the numbers are an accessor, and .rtt files, where they follow.
#pragma once

#include "lambent/asset/accessors.h"
#include "lambent/asset/faults.h"
#include "lambent/asset/part_bytes.h"
#include "lambent/transfer/field.h"

namespace lambent::asset {

nlohmann::json toJson(const transfer::EncodedRtt& rtt, scene_io::GltfBuilder& gltf);
transfer::EncodedRtt rttFrom(JsonFields object, AccessorReader& accessors);
/// All but the numbers. `deepest`: metres, the most that a depth can say.
transfer::EncodedRtt rttShapeFrom(JsonFields& object, double deepest);
Wrong faultOf(const transfer::EncodedRtt& rtt);
void count(const transfer::EncodedRtt& rtt, PartBytes& bytes);

}  // namespace lambent::asset
