// Where sets of texture coordinates stand among the attributes that are written.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// A set that is written as TEXCOORD_n.
struct UvSlot {
  int slot = 0;                                   ///< n
  const scene::VertexNumbers* numbers = nullptr;  ///< or `uvs`
  const std::vector<Vec2>* uvs = nullptr;
};

/// TEXCOORD_0 is Mesh::uvs and TEXCOORD_1, where any mesh has them, Mesh::texelUvs; the sets of the
/// source that light does not ask for follow, each with the same number in all meshes: materials
/// are shared.
class UvSlots {
 public:
  /// `wanted`: the sets that textures besides base colours are looked up with, of all materials.
  UvSlots(const scene::Scene& scene, const std::set<int>& wanted);

  /// The TEXCOORD_n that a set of the source is now; 0 for one that no mesh has.
  int slotOf(int set) const;

  /// What a mesh, whose materials want these sets, has besides Mesh::uvs and Mesh::texelUvs, in the
  /// sequence of slots. A gap below, which glTF does not allow, is filled with what is there.
  std::vector<UvSlot> of(const scene::Mesh& mesh, const std::set<int>& wanted) const;

 private:
  std::optional<int> first_;  ///< the set that all of Mesh::uvs are
  std::map<int, int> slots_;  ///< by set
};

}  // namespace lambent::scene_io
