// A glTF 2.0 file opened for reading: its JSON, its buffers, and accessors whose every byte has
// been checked to lie inside them. load() turns it into a Scene; a reader of an extension gets at
// its own JSON and accessors through the same object.
//
//   auto file = GltfFile::open(path);              // .glb or .gltf
//   auto loaded = loadGltf(*file);                 // LoadedScene
//   file->json()["meshes"][i]["primitives"][0]["extensions"]…   // include <nlohmann/json.hpp>
//   auto bytes = file->accessorBytes(index);       // view.bytes, view.stride, view.count
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/linked_files.h"
#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

/// Elements of an accessor in place: element i begins at bytes[i·stride]. All of
/// (count−1)·stride + componentCount·componentSize bytes are inside the span.
struct AccessorView {
  std::span<const std::byte> bytes;
  std::size_t count = 0, stride = 0;
  Component component = Component::Float;
  int componentCount = 1;  ///< SCALAR 1, VEC2 2, …, MAT4 16
  bool normalized = false;

  std::size_t elementSize() const;  ///< componentCount × bytes of a component
  bool packed() const { return stride == elementSize(); }
};

class GltfFile {
 public:
  /// Reads and checks the container, the JSON and the buffers (embedded, data URIs, and files
  /// beside `path`). Errors are BadInput and name the file.
  static Result<GltfFile> open(const std::filesystem::path& path, const LoadOptions& options = {});
  GltfFile(GltfFile&&) noexcept;
  GltfFile& operator=(GltfFile&&) noexcept;
  ~GltfFile();

  const std::filesystem::path& path() const;
  const nlohmann::json& json() const;
  /// The files that this one names, and the account of what reading costs, for all who read from
  /// it.
  LinkedFiles& linkedFiles() const;
  file::Budget& budget() const;

  /// Bounds-checked; valid as long as this object lives. A sparse accessor is an error here (read
  /// it with accessorFloats). The error names the accessor and what is wrong with it.
  Result<AccessorView> accessorView(std::int64_t accessor) const;
  /// The bytes of a tightly packed accessor: what GltfBuilder::addAccessor was given.
  Result<std::span<const std::byte>> accessorBytes(std::int64_t accessor) const;
  /// Any accessor as floats, count × componentCount, normalized integers scaled to [0, 1] or
  /// [−1, 1], sparse ones filled in.
  Result<std::vector<float>> accessorFloats(std::int64_t accessor, int componentCount) const;
  /// Any accessor of whole numbers (indices, joints), as they are in the file.
  Result<std::vector<std::uint32_t>> accessorIntegers(std::int64_t accessor,
                                                      int componentCount) const;
  /// The bytes of a buffer view, decompressed where they are (EXT_meshopt_compression).
  Result<std::span<const std::byte>> bufferViewBytes(std::int64_t bufferView) const;

  struct Impl;

 private:
  explicit GltfFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What load() does with a .glb or .gltf, and which glTF primitive every mesh came from.
struct LoadedGltf {
  LoadedScene loaded;
  struct Origin {
    int node = 0, mesh = 0, primitive = 0;
    /// Whether mesh.positions are the file's POSITION elements, all of them and in their sequence,
    /// and likewise the triangles: then per-vertex data of an extension fits. False where unused
    /// vertices or degenerate triangles were dropped.
    bool verticesKept = true;
  };
  std::vector<Origin> origins;  ///< one for each of loaded.scene.meshes
};
struct GltfLoadOptions {
  /// Keep unused vertices and degenerate triangles, so that per-vertex data of an extension fits.
  /// For files that Lambent wrote itself.
  bool keepAllVertices = false;
  /// Radians: normals that the file does not give are smooth across edges flatter than this.
  float crease = 0.0f;
  bool layout = false;              ///< as of LoadOptions
  Sides sides = Sides::AsFileSays;  ///< as of LoadOptions; with keepAllVertices none are given
};
Result<LoadedGltf> loadGltf(const GltfFile& file, const GltfLoadOptions& options = {});

}  // namespace lambent::scene_io
