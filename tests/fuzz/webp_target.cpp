// WebP as a light and as a texture.
#include "tests/fuzz/picture_use.h"

namespace lambent::fuzz {

void webp(Bytes bytes) {
  if (image::formatOf(bytes) != image::Format::WebP) return;
  std::optional<image::Image> picture = pictureIn(bytes, image::Format::WebP);
  useAsTexture(bytes, picture.has_value());
  if (picture) useAsLight(std::move(*picture));
}

}  // namespace lambent::fuzz
