// PNG as a light and as a texture.
#include "tests/fuzz/picture_use.h"

namespace lambent::fuzz {

void png(Bytes bytes) {
  if (image::formatOf(bytes) != image::Format::Png) return;
  std::optional<image::Image> picture = pictureIn(bytes, image::Format::Png);
  useAsTexture(bytes, picture.has_value());
  if (!picture) return;
  if (picture->pixels.size() <= kMostElements) {
    // 16 bits are rounded once; colour under coverage is rounded by each multiplication.
    const image::Image rounded = writtenAndRead(*picture, "again.png");
    const image::Image again = writtenAndRead(rounded, "again.png");
    require(same(rounded, again) || !rounded.alpha.empty(), "eight bits are kept as they are");
  }
  useAsLight(std::move(*picture));
}

}  // namespace lambent::fuzz
