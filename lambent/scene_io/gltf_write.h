// Scene → glTF 2.0 document, open for a caller that adds an extension before it is written.
//
// Primitive order: glTF mesh i and its single primitive belong to scene.meshes[i]; glTF material i
// to scene.materials[i]. Node i shows mesh i, and cameras follow as further nodes; or, where the
// scene has a source, the tree of its nodes is there (gltf_write_source.h). Nodes that show a mesh
// have the identity transform, because a Scene is in world space.
//
// A reader needs <nlohmann/json.hpp> only in the .cpp that calls json():
//
//   GltfBuilder gltf(scene);
//   const int accessor = gltf.addAccessor(bytes, Component::Float, "SCALAR", count);
//   gltf.useExtension("LAMBENT_radiance_transfer");
//   gltf.json()["meshes"][i]["primitives"][0]["extensions"]["LAMBENT_…"]["vectors"] = accessor;
//   file::writeAtomically(path, *gltf.glb());
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

struct UvSlot;

/// glTF's componentType.
enum class Component {
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126
};

class GltfBuilder {
 public:
  explicit GltfBuilder(const scene::Scene& scene);
  GltfBuilder(GltfBuilder&&) noexcept;
  GltfBuilder& operator=(GltfBuilder&&) noexcept;
  ~GltfBuilder();

  /// Appends bytes to the binary chunk, 4-aligned. Returns the index of the new bufferView.
  /// `target`: 34962 (vertices) or 34963 (indices), or none.
  int addBufferView(std::span<const std::byte> bytes, std::optional<int> target = {});

  /// A buffer view and an accessor over it. `type`: "SCALAR", "VEC2", "VEC3", "VEC4". Bytes are
  /// tightly packed: glTF wants every element of a *vertex attribute* to be 4-aligned; other
  /// accessors need not be. Returns the accessor's index.
  int addAccessor(std::span<const std::byte> bytes, Component component, std::string_view type,
                  std::size_t count, bool normalized = false, std::optional<int> target = {});

  /// Adds to extensionsUsed (and extensionsRequired, which makes other readers refuse the file).
  void useExtension(std::string_view name, bool required = false);

  /// The document, to read and to add to.
  nlohmann::json& json();

  /// The whole .glb. Fails where the container's 4 GiB would be exceeded.
  Result<std::vector<std::byte>> glb() const;

 private:
  /// What a mesh has at its vertices besides.
  void addOthers(const scene::Mesh& mesh, const std::vector<UvSlot>& sets,
                 nlohmann::json& attributes);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes a scene as .glb, atomically. load() reads the same scene back: reflectances and lobe
/// exponents that metallic-roughness cannot say exactly are kept in material.extras.lambent. What
/// its source said beyond the scene (scene/source.h) is said again.
Status saveGlb(const scene::Scene& scene, const std::filesystem::path& path);

}  // namespace lambent::scene_io
