// A picture of an atlas for a person: its charts, and beside them where the patch stands.
#pragma once

#include <cstdint>
#include <filesystem>

#include "lambent/asset/asset.h"
#include "lambent/atlas/atlas.h"
#include "lambent/report/result.h"

namespace lambent::tool {

/// Left: a colour for each chart. Right: the id map, q as red and green, dilated texels darker.
Status writeAtlasPicture(const atlas::Atlas& atlas, const asset::Asset& asset, std::uint32_t mesh,
                         const std::filesystem::path& path);

}  // namespace lambent::tool
