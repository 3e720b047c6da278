// What frames are drawn into, and the sum of them.
#pragma once

#include "lambent/image/image.h"
#include "lambent/render/gl_objects.h"

namespace lambent::render {

struct GlTarget {
  Texture color, depth, sum;
  Framebuffer framebuffer;
  Program accumulate;
  int width = 0, height = 0;

  static Result<GlTarget> make(int width, int height);
  /// Black and without coverage, at the far plane.
  void clear() const;
  void clearSum() const;
  void addToSum() const;
  /// The mean of `samples` frames.
  Result<image::Image> mean(int samples) const;
};

}  // namespace lambent::render
