// What mirrors and the background show, on the GPU (shaders/environment.glsl).
#pragma once

#include "lambent/light/environment.h"
#include "lambent/render/gl_objects.h"

namespace lambent::render {

class GlEnvironment {
 public:
  /// Uploads what `environment` is now; nothing is kept of it.
  static Result<GlEnvironment> make(const light::Environment& environment, int largestTexture);
  /// For the program that draws next, which includes environment.glsl.
  void bind(const Program& program, const Mat3& environmentFromWorld) const;

 private:
  Texture picture_;
};

}  // namespace lambent::render
