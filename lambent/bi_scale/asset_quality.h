// How good the lay-out of the patches of an asset is.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/synthesis/result_quality.h"

namespace lambent::bi_scale {

struct MeshQuality {
  std::uint32_t mesh = 0;
  Vec2 period = Vec2::Zero();  ///< of the patch on the mesh, metres
  synthesis::ResultQuality quality;
};

/// Of every mesh that wears a patch by an id map, in sequence.
std::vector<MeshQuality> qualityOf(const asset::Asset& asset);

}  // namespace lambent::bi_scale
