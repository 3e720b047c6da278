// What a scene was read from, said again in the document that it is written to: whose it is,
// materials with all their textures, the tree of nodes.
//
// Nodes are written with their names, extras and children, and stand at the origin where a mesh is
// below them: their transforms are in the vertices. What has no mesh below it (cameras, lamps, what
// marks a place) stands where it stood.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "lambent/scene/source.h"
#include "lambent/scene_io/uv_slots.h"

namespace lambent::scene_io {

class SourceWriter {
 public:
  /// Puts a picture into the document and returns its bufferView.
  using AddPicture = std::function<int(const std::vector<std::uint8_t>&)>;

  /// `scene` has a source; what is written goes into `document`.
  SourceWriter(const scene::Scene& scene, nlohmann::json& document, AddPicture addPicture);

  /// What concerns the whole: the asset, the scene, what extensions have at the root.
  void writeHead();
  /// What the source says of a texture of the scene, put into its image and its texture, which gets
  /// a sampler.
  void dressTexture(const scene::Texture& texture, nlohmann::json& imageJson,
                    nlohmann::json& textureJson);
  /// A texture of the scene was written as the next one, with this image.
  void note(const scene::Texture& texture, int image);

  /// A material as it was, as far as the scene's does not say otherwise since. `plain`: as the
  /// scene's would be written without a source. Other textures are written as they are met.
  nlohmann::json material(const scene::Material& now, const nlohmann::json& plain);

  /// What a mesh has in further sets of texture coordinates.
  std::vector<UvSlot> uvSlotsOf(const scene::Mesh& mesh) const;
  /// Names, extras and extensions of a mesh and its primitive.
  void dressMesh(const scene::Mesh& mesh, nlohmann::json& meshJson) const;

  /// The tree with the scene's meshes and cameras. False, and nothing is done, where it does not
  /// have them in the scene's sequence.
  bool writeNodes();

  /// Once all is written.
  void declareExtensions();

 private:
  const nlohmann::json* fromList(const char* list, int index) const;
  int textureOf(int sourceTexture);
  int samplerOf(const nlohmann::json& texture);
  int cameraOf(int sourceCamera);
  bool hasSequence(const std::vector<std::vector<int>>& meshesAt) const;

  const scene::Scene& scene_;
  const scene::Source& source_;
  nlohmann::json& document_;
  AddPicture addPicture_;
  nlohmann::json from_;
  std::vector<std::set<int>> wanted_;  ///< sets of texture coordinates, by material of the source
  UvSlots slots_;
  std::map<int, int> materialAt_;  ///< of the scene, by that of the source
  std::map<int, int> textures_, images_, samplers_, cameras_;  ///< by those of the source
};

}  // namespace lambent::scene_io
