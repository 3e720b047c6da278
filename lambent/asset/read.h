// Reading an asset or an .rtt that may come from anywhere: what it may cost, and what it names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "lambent/asset/asset.h"

namespace lambent::asset {

struct ReadOptions {
  /// Whether the files that an asset names (buffers, pictures) may lie anywhere, not only in its
  /// folder and below. For assets that you trust.
  bool allowOutside = false;
  /// Bytes that reading may take; nothing: as much as a file of that size may need (see
  /// file/budget.h).
  std::optional<std::uint64_t> memoryLimit = {};
};

/// read() of asset.h is this with the options as they are.
Result<Asset> read(const std::filesystem::path& path, const ReadOptions& options);

/// The files that a .glb or .gltf names, there or not: buffers and pictures; none of what is not
/// glTF. As cheap as isAsset().
Result<std::vector<std::filesystem::path>> linkedFiles(const std::filesystem::path& path);

}  // namespace lambent::asset
