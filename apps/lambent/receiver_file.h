// Exit radiance per receiver as a file: binary PLY or CSV with the columns x, y, z, nx, ny, nz, r,
// g, b in world space.
#pragma once

#include <filesystem>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/report/result.h"

namespace lambent::tool {

struct ShadedReceiver {
  Vec3 position, normal;
  Rgb radiance;
};

/// By extension, .ply (little-endian floats) or .csv. Atomic.
Status writeReceivers(const std::vector<ShadedReceiver>& receivers,
                      const std::filesystem::path& path);
/// Reads what writeReceivers wrote.
Result<std::vector<ShadedReceiver>> readReceivers(const std::filesystem::path& path);

}  // namespace lambent::tool
