// glTF, OBJ, PLY → Scene, with a diagnosis of what was odd in the file.
#pragma once

#include <filesystem>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

struct LoadedScene {
  scene::Scene scene;
  Findings findings;  ///< degenerate triangles kept out, normals made, flipped normals, …
};

/// By extension: .glb .gltf .obj .ply. A file that cannot be used is ErrorKind::BadInput whose
/// message names the file, the place in it, and the remedy. Never yields NaN positions, indices out
/// of range, non-unit normals or an empty scene.
Result<LoadedScene> load(const std::filesystem::path& path);

}  // namespace lambent::scene_io
