// Materials of OBJ files.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lambent/scene_io/diagnosis.h"
#include "lambent/scene_io/file_finder.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/mtl_map.h"

namespace lambent::scene_io {

struct MtlEntry;

/// Reads .mtl files into a scene's materials and textures. What a material means:
///  - Kd (linear) and map_Kd are diffuse; Kd of 0 with a map counts as 1. Of the map's options, -s
///    and -o change the texture coordinates of the meshes (uvOf()), -clamp is the texture's.
///  - Pm or Pr (metallic, roughness): as glTF's metallic-roughness with Kd as base.
///  - Ke is emission.
///  - illum 3 or 5 with Ks: a mirror of reflectance Ks.
///  - illum 0 or 1: diffuse alone, whatever Ks says.
///  - otherwise Ks is glossy with lobe exponent Ns (1 … 10⁴), except for Ks = 0.5 0.5 0.5, which
///    Blender writes for every material ("specular 0.5", which means 4% there): diffuse alone.
///  - Kd + Ks above 1 is scaled down to 1.
///  - d or 1 − Tr, and map_d (its alpha, or its grey): the share of the surface that is there.
/// What else changes how a material looks is a finding: illum of glass, relief, other maps, options.
class MtlReader {
 public:
  MtlReader(scene::Scene& scene, LinkedFiles& files, FileFinder& finder, Diagnosis& diagnosis)
      : scene_(scene), files_(files), finder_(finder), diagnosis_(diagnosis) {}

  /// A file that has been read is not read again. One that is missing or unreadable is a Warning:
  /// the geometry is there. A picture that is damaged or too large is an error, and so is a file
  /// outside of the scene's folder unless it may lie there. `scene` is the scene's folder.
  Status read(const std::filesystem::path& path, const std::filesystem::path& scene);

  /// The material that `usemtl NAME` means, with a comment behind it or not, or −1.
  int find(std::string_view name) const;
  /// What a map's options do to the coordinates of meshes of this material.
  UvTransform uvOf(int material) const;
  /// After the last file: leaves out pictures of which others with their colour or alpha were made.
  void dropParts();

 private:
  Status add(const MtlEntry& entry);
  void tellUnread(const MtlEntry& entry);
  Result<int> texture(const MtlMap& map);
  Result<int> textureOf(const MtlEntry& entry);

  scene::Scene& scene_;
  LinkedFiles& files_;
  FileFinder& finder_;
  Diagnosis& diagnosis_;
  std::filesystem::path folder_, sceneFolder_;  ///< of the .mtl, of the scene
  std::set<std::filesystem::path> read_;
  std::map<std::string, int, std::less<>> materials_;
  std::map<int, UvTransform> uvs_;
  std::map<std::pair<int, int>, int> combined_;  ///< by textures of colour and alpha
  std::map<std::pair<std::filesystem::path, bool>, int> textures_;  ///< by place and clamping
};

/// The picture `name` of a model in `folder` as a texture; −1 and a Warning if it is missing or of a
/// kind that is not read.
Result<int> readTextureFile(const FileFinder::Found& found, scene::Scene& scene, LinkedFiles& files,
                            Diagnosis& diagnosis);

}  // namespace lambent::scene_io
