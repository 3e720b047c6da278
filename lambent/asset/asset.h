// The asset: an ordinary glTF 2.0 binary that any viewer opens, with the extension
// LAMBENT_radiance_transfer (spec/) that makes it relightable.
#pragma once

#include <filesystem>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/transfer/field.h"

namespace lambent::asset {

struct Asset {
  scene::Scene scene;
  transfer::EncodedField transfer;  ///< transfer.meshes[i] belongs to scene.meshes[i]
};

/// Writes atomically: the file appears whole or not at all.
Status write(const Asset& asset, const std::filesystem::path& path);
Result<Asset> read(const std::filesystem::path& path);
/// Whether a .glb carries the extension (a cheap look at its JSON).
Result<bool> isAsset(const std::filesystem::path& path);

}  // namespace lambent::asset
