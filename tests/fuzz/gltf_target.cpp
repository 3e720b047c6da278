// glTF 2.0: a .glb by its first bytes, otherwise the JSON of a .gltf.
#include "lambent/scene_io/load.h"
#include "tests/fuzz/folder.h"
#include "tests/fuzz/scene_use.h"

namespace lambent::fuzz {

void gltf(Bytes bytes) {
  const bool binary = textOf(bytes).starts_with("glTF");
  const auto path = Folder::ofProcess().write(binary ? "scene.glb" : "scene.gltf", bytes);
  scene_io::LoadOptions options;
  options.memoryLimit = kMemoryLimit;
  const Result<scene_io::LoadedScene> loaded = scene_io::load(path, options);
  if (!loaded) return require(loaded.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  requireSound(loaded->scene);
  use(loaded->scene);
}

}  // namespace lambent::fuzz
