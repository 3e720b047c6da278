// Exit radiance per receiver as a file: binary PLY or CSV with the columns x, y, z, nx, ny, nz, r,
// g, b in world space, and vr, vg, vb where the radiance is an estimate with a variance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
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
/// `memoryLimit`: bytes; nothing: as much as a file of that size may need (see file/budget.h).
Result<ReceiverFile> readReceivers(const std::filesystem::path& path,
                                   std::optional<std::uint64_t> memoryLimit);

}  // namespace lambent::tool
