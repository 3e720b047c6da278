#include "lambent/bi_scale/asset_quality.h"

#include <variant>

#include "lambent/transfer/encode.h"

namespace lambent::bi_scale {

std::vector<MeshQuality> qualityOf(const asset::Asset& asset) {
  std::vector<MeshQuality> all;
  for (std::uint32_t m = 0; m < asset.transfer.meshes.size(); ++m) {
    const auto* worn = std::get_if<transfer::BiScale<transfer::Numbers>>(&asset.transfer.meshes[m]);
    if (!worn || !worn->patch.idMap()) continue;
    const transfer::EncodedRtt& rtt = asset.transfer.rtts[std::size_t(worn->patch.rtt)];
    const Vec2 period = worn->patch.scale * rtt.size;
    all.push_back({m, period,
                   synthesis::resultQualityOf(
                       {asset.scene.meshes[m], worn->tangents, *worn->patch.idMap(), period},
                       transfer::decode(rtt))});
  }
  return all;
}

}  // namespace lambent::bi_scale
