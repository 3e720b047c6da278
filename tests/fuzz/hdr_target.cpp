// Radiance pictures.
#include "tests/fuzz/picture_use.h"

namespace lambent::fuzz {

void hdr(Bytes bytes) {
  std::optional<image::Image> picture = pictureIn(bytes, image::Format::Hdr);
  if (!picture) return;
  if (picture->pixels.size() <= kMostElements) {
    // What is no RGBE (exposures, XYZ) is rounded once.
    const image::Image rounded = writtenAndRead(*picture, "again.hdr");
    require(same(rounded, writtenAndRead(rounded, "again.hdr")), "RGBE is kept as it is");
  }
  useAsLight(std::move(*picture));
}

}  // namespace lambent::fuzz
