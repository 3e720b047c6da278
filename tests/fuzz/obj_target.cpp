// OBJ and MTL: what stands behind a line "#=== scene.mtl" is the material library. The folder's
// tile.png lies beside them.
#include <algorithm>

#include "lambent/scene_io/load.h"
#include "tests/fuzz/folder.h"
#include "tests/fuzz/scene_use.h"

namespace lambent::fuzz {

void obj(Bytes bytes) {
  constexpr std::string_view kBorder = "#=== scene.mtl\n";
  const std::string_view text = textOf(bytes);
  const std::size_t border = std::min(text.find(kBorder), text.size());
  const Folder& folder = Folder::ofProcess();
  folder.write("scene.mtl", text.substr(std::min(border + kBorder.size(), text.size())));
  scene_io::LoadOptions options;
  options.memoryLimit = kMemoryLimit;
  const Result<scene_io::LoadedScene> loaded =
      scene_io::load(folder.write("scene.obj", text.substr(0, border)), options);
  if (!loaded) return require(loaded.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  requireSound(loaded->scene);
  use(loaded->scene);
}

}  // namespace lambent::fuzz
