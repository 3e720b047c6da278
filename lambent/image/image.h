// Pixels: linear RGB floats, top row first.
#pragma once

#include <vector>

#include "lambent/math/types.h"

namespace lambent::image {

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;   ///< width·height, row after row from the top
  std::vector<float> alpha;  ///< coverage in [0, 1], as many, or empty: opaque. Colour is
                             ///< associated (multiplied by coverage already), as averaged samples
                             ///< over black are and as EXR stores it

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(size_t(w) * h, Rgb::Zero()) {}
  Rgb& at(int x, int y) { return pixels[size_t(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[size_t(y) * width + x]; }
};

}  // namespace lambent::image
