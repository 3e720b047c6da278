// Files → Patch: pictures of heights, meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "lambent/meso/patch.h"
#include "lambent/report/finding.h"
#include "lambent/report/result.h"

namespace lambent::meso {

/// Which axis of a mesh file points away from the patch. Files that are +Y up, as glTF wants it and
/// OBJ usually has it, hold a patch that lies on the ground: patch (x, y, z) = file (x, −z, y).
enum class UpAxis { Y, Z };

struct PatchFileOptions {
  /// Metres: the period. Height fields: 0.1 along x and by the picture's aspect along y. Meshes:
  /// their bounding box.
  std::optional<Vec2> size;
  /// Metres between the lowest and the highest that a height field may be. PNG: from black to
  /// white; 0.15 of the period. EXR: from the least to the greatest number; without it, numbers are
  /// metres.
  std::optional<float> depth;
  std::filesystem::path color;       ///< of a height field: PNG or JPEG, stretched over the period
  Rgb albedo = Rgb::Constant(0.7f);  ///< of a height field without a colour picture
  float blend = 0.0f;                ///< see withBlendedBorders, 0 … 0.5
  int maximumSamples = 512;  ///< a side; larger height fields are averaged down (with a note)
  UpAxis up = UpAxis::Y;     ///< of a mesh file
  Rgb backing = Rgb::Constant(0.05f);  ///< under a mesh: it may be open below
  bool allowOutside = false;           ///< of a mesh: as of scene_io::LoadOptions
  /// Bytes that reading may take; nothing: as much as files of that size may need (see
  /// file/budget.h).
  std::optional<std::uint64_t> memoryLimit = {};
};

struct LoadedPatch : WithFindings<Patch> {
  /// The files that a mesh names, as of scene_io::LoadedScene.
  std::vector<std::filesystem::path> linkedFiles;
};

/// By extension: .png and .exr are height fields (PNG: code values, 8 or 16 bits, of the mean of
/// its channels; EXR: the mean of R, G and B), top row at the far side (+y); .glb .gltf .obj .ply
/// are meshes. Seams are reported (see checkTiling). BadInput names the file and the remedy.
Result<LoadedPatch> loadPatch(const std::filesystem::path& path, const PatchFileOptions& options);

/// Writes a patch's geometry, with its backing, as a .glb that lies on the ground (+Y up): what
/// loadPatch reads by default.
Status savePatch(const Patch& patch, const std::filesystem::path& path);

}  // namespace lambent::meso
