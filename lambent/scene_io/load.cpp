#include "lambent/scene_io/load.h"

#include <new>
#include <string>

#include "lambent/file/extension.h"
#include "lambent/scene_io/gltf_read.h"
#include "lambent/scene_io/obj.h"
#include "lambent/scene_io/ply.h"

namespace lambent::scene_io {
namespace {

Result<LoadedScene> loadByExtension(const std::filesystem::path& path, const LoadOptions& options) {
  const std::string extension = file::extensionOf(path);
  if (extension == ".glb" || extension == ".gltf") {
    const Result<GltfFile> file = GltfFile::open(path, options);
    if (!file) return file.error();
    Result<LoadedGltf> loaded = loadGltf(*file, {.crease = options.crease.value_or(0.0f),
                                                 .layout = options.layout,
                                                 .sides = options.sides});
    if (!loaded) return loaded.error();
    return std::move(loaded->loaded);
  }
  if (extension == ".obj") return loadObj(path, options);
  if (extension == ".ply") return loadPly(path, options);
  return report::badInput(path.string() +
                          ": a scene is a .glb, .gltf, .obj or .ply file; convert it to one of "
                          "these");
}

}  // namespace

Result<LoadedScene> load(const std::filesystem::path& path, const LoadOptions& options) {
  try {
    return loadByExtension(path, options);
  } catch (const std::bad_alloc&) {
    return report::failed(path.string() + ": there is not enough memory to read it");
  }
}

}  // namespace lambent::scene_io
