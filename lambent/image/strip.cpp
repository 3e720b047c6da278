#include "lambent/image/strip.h"

#include <algorithm>
#include <cassert>

namespace lambent::image {

Image over(const Image& picture, const Rgb& backdrop) {
  Image out(picture.width, picture.height);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const float alpha = picture.alpha.empty() ? 1.0f : picture.alpha[i];
    out.pixels[i] = picture.pixels[i] + (1.0f - alpha) * backdrop;
  }
  return out;
}

Image strip(std::span<const Image> panels, int gap, const Rgb& gapColor) {
  if (panels.empty()) return {};
  int width = gap * (int(panels.size()) - 1);
  for (const Image& panel : panels) width += panel.width;
  Image out(width, panels.front().height);
  std::fill(out.pixels.begin(), out.pixels.end(), gapColor);
  int left = 0;
  for (const Image& panel : panels) {
    assert(panel.height == out.height);
    for (int y = 0; y < panel.height; ++y)
      std::copy_n(&panel.at(0, y), panel.width, &out.at(left, y));
    left += panel.width + gap;
  }
  return out;
}

}  // namespace lambent::image
