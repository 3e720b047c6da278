// Wavefront OBJ with MTL materials.
#pragma once

#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Reads v (with optional vertex colours, taken as sRGB), vt, vn, f with negative indices and any
/// number of corners, o, usemtl and mtllib. One mesh for each pair of object and material. Groups,
/// smoothing groups, lines, points and curves are left out.
Result<LoadedScene> loadObj(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lambent::scene_io
