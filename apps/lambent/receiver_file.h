// Exit radiance per receiver as a file: binary PLY or CSV with the columns x, y, z, nx, ny, nz, r,
// g, b in world space, and vr, vg, vb where the radiance is an estimate with a variance.
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

struct ReceiverFile {
  std::vector<ShadedReceiver> receivers;
  std::vector<Rgb> variances;  ///< of the radiances, one each, or empty: columns vr, vg, vb
};

/// By extension, .ply (little-endian floats) or .csv. Atomic.
Status writeReceivers(const ReceiverFile& file, const std::filesystem::path& path);
/// Reads what writeReceivers wrote.
Result<ReceiverFile> readReceivers(const std::filesystem::path& path);

}  // namespace lambent::tool
