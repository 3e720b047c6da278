// Transfer to bare surfaces in a file: to JSON, from JSON, what is wrong with it, its bytes.
#pragma once

#include "lambent/asset/accessors.h"
#include "lambent/asset/faults.h"
#include "lambent/asset/part_bytes.h"
#include "lambent/transfer/field.h"

namespace lambent::asset {

/// `kind`: the field's, whose response is the primitive's own; what else is held stands beside it.
nlohmann::json toJson(const transfer::Surface<transfer::Numbers>& surface, const scene::Mesh& mesh,
                      transfer::Kind kind, scene_io::GltfBuilder& gltf);
transfer::Surface<transfer::Numbers> surfaceFrom(JsonFields& object, AccessorReader& accessors,
                                                 transfer::SharedReceivers receivers,
                                                 transfer::Kind kind);
Wrong faultOf(const transfer::Surface<transfer::Numbers>& surface,
              const transfer::EncodedField& field);
void count(const transfer::Surface<transfer::Numbers>& surface, PartBytes& bytes);

}  // namespace lambent::asset
