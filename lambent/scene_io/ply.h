// Stanford PLY: ascii, binary_little_endian, binary_big_endian.
#pragma once

#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Reads element vertex (x y z; nx ny nz; s t, u v or texture_u texture_v; red green blue, integers
/// as sRGB and floats as linear), element face (vertex_indices or vertex_index) and element
/// tristrips; skips whatever else the header declares. "comment TextureFile NAME" is the
/// base-colour texture.
Result<LoadedScene> loadPly(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lambent::scene_io
