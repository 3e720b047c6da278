// glTF, OBJ, PLY → Scene, with a diagnosis of what was odd in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

struct LoadedScene {
  scene::Scene scene;
  Findings findings;  ///< degenerate triangles kept out, normals made, flipped normals, …
  /// The files that this one names, read or not, there or not: buffers, pictures, material
  /// libraries.
  std::vector<std::filesystem::path> linkedFiles = {};
};

/// What has a back of its own, that is lit and seen as its front is.
enum class Sides {
  AsFileSays,  ///< open surfaces that glTF calls double-sided
  One,         ///< nothing: seen from behind, all is black
  Two,         ///< everything, bodies that are closed too
};

struct LoadOptions {
  /// Whether the files that the scene names (buffers, pictures, material libraries) may lie
  /// anywhere, not only in its folder and below. For scenes that you trust.
  bool allowOutside = false;
  /// Bytes that reading may take, textures and geometry together; nothing: as much as files of that
  /// size may need (see file/budget.h).
  std::optional<std::uint64_t> memoryLimit = {};
  /// Radians: normals that a file does not give are smooth across edges that bend by less. Nothing:
  /// as the format has it, flat in glTF (a MUST of its specification, §3.7.2.1), smooth in OBJ and
  /// PLY.
  std::optional<float> crease = {};
  /// Texture coordinates are for texels of transfer: where a glTF mesh has a second set, which by
  /// custom is laid out without overlap for light maps, and no texture, it is taken.
  bool layout = false;
  Sides sides = Sides::AsFileSays;
};

/// By extension: .glb .gltf .obj .ply. A file that cannot be used is ErrorKind::BadInput whose
/// message names the file, the place in it, and the remedy. Never yields NaN positions, indices out
/// of range, non-unit normals or an empty scene.
Result<LoadedScene> load(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace lambent::scene_io
