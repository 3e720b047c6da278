// Materials of OBJ files.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/linked_files.h"

namespace lambent::scene_io {

/// Reads an .mtl file and appends to scene.materials and scene.textures; `known` maps names to
/// material indices. What a material means:
///  - Kd (linear) and map_Kd are diffuse; Kd of 0 with a map counts as 1.
///  - Pm or Pr (metallic, roughness): as glTF's metallic-roughness with Kd as base.
///  - illum 3 or 5 with Ks: a mirror of reflectance Ks.
///  - illum 0 or 1: diffuse alone, whatever Ks says.
///  - otherwise Ks is glossy with lobe exponent Ns (1 … 10⁴), except for Ks = 0.5 0.5 0.5, which
///    Blender writes for every material ("specular 0.5", which means 4% there): diffuse alone.
///  - Kd + Ks above 1 is scaled down to 1.
/// A missing or unreadable file is a Warning: the geometry is there. A picture that is damaged or
/// too large is an error, and so is a file outside of the scene's folder unless it may lie there.
/// `libraries` names those that were read already, which are not read again.
Status readMtl(const std::filesystem::path& path, scene::Scene& scene,
               std::map<std::string, int, std::less<>>& known,
               std::set<std::filesystem::path>& libraries, LinkedFiles& files,
               Diagnosis& diagnosis);

/// Reads an image file beside a model as a texture; −1 and a Warning if it is missing or of a kind
/// that is not read.
Result<int> readTextureFile(const std::filesystem::path& path, scene::Scene& scene,
                            LinkedFiles& files, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
