// Stanford PLY: ascii, binary_little_endian, binary_big_endian.
#pragma once

#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Reads element vertex (x y z; nx ny nz; s t, u v or texture_u texture_v; red green blue, integers
/// as sRGB, floats as linear, or as sRGB where they go beyond 1), element face (vertex_indices or
/// vertex_index; texcoord, texnumber; red green blue) and element tristrips; skips whatever else the
/// header declares, with a finding. "comment TextureFile NAME" is a base-colour texture. What
/// belongs to a face's corners makes vertices of its own there.
Result<LoadedScene> loadPly(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lambent::scene_io
