// Wavefront OBJ with MTL materials.
#pragma once

#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Reads v (with optional vertex colours, taken as sRGB, counted to 1 or to 255), vt, vn, f with
/// negative indices and any number of corners, o, s, usemtl and mtllib. One mesh for each pair of
/// object and material. Where no normals are given they are made: smooth within a smoothing group,
/// flat where smoothing is off, smooth everywhere if the file says nothing of it. What is left out
/// is a finding (obj_unread.h, mtl.h).
Result<LoadedScene> loadObj(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lambent::scene_io
