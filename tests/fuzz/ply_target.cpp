// PLY, in text and binary. The folder's tile.png lies beside it.
#include "lambent/scene_io/load.h"
#include "tests/fuzz/folder.h"
#include "tests/fuzz/scene_use.h"

namespace lambent::fuzz {

void ply(Bytes bytes) {
  const Folder& folder = Folder::ofProcess();
  scene_io::LoadOptions options;
  options.memoryLimit = kMemoryLimit;
  const Result<scene_io::LoadedScene> loaded =
      scene_io::load(folder.write("scene.ply", bytes), options);
  if (!loaded) return require(loaded.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  requireSound(loaded->scene);
  use(loaded->scene);
}

}  // namespace lambent::fuzz
