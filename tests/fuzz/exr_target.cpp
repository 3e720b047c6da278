// OpenEXR pictures, and a further layer of them.
#include "lambent/image/io.h"
#include "tests/fuzz/folder.h"
#include "tests/fuzz/picture_use.h"

namespace lambent::fuzz {

void exr(Bytes bytes) {
  if (textOf(bytes).find("variance.") != std::string_view::npos) {
    image::ReadOptions options;
    options.memoryLimit = kMemoryLimit;
    (void)image::readLayer(Folder::ofProcess().write("in.exr", bytes), "variance", options);
  }
  std::optional<image::Image> picture = pictureIn(bytes, image::Format::Exr);
  if (!picture) return;
  if (picture->pixels.size() <= kMostElements) {
    require(same(*picture, writtenAndRead(*picture, "again.exr")), "EXR keeps every bit");
  }
  useAsLight(std::move(*picture));
}

}  // namespace lambent::fuzz
