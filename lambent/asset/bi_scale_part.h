// Transfer to surfaces with meso-structure in a file: to JSON, from JSON, what is wrong with it,
// its bytes.
#pragma once

#include "lambent/asset/accessors.h"
#include "lambent/asset/faults.h"
#include "lambent/asset/part_bytes.h"
#include "lambent/transfer/field.h"

namespace lambent::asset {

nlohmann::json toJson(const transfer::BiScale<transfer::Numbers>& biScale, const scene::Mesh& mesh,
                      scene_io::GltfBuilder& gltf);
transfer::BiScale<transfer::Numbers> biScaleFrom(JsonFields& object, AccessorReader& accessors,
                                                 transfer::SharedReceivers receivers);
Wrong faultOf(const transfer::BiScale<transfer::Numbers>& biScale, const scene::Mesh& mesh,
              const transfer::EncodedField& field);
void count(const transfer::BiScale<transfer::Numbers>& biScale, PartBytes& bytes);

}  // namespace lambent::asset
