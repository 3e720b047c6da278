// Marks over a picture, as viewers draw them on a surface: lines and dots of a width in pixels,
// which the surface before them hides.
#pragma once

#include <span>

#include "lambent/render/gl_objects.h"
#include "lambent/scene/camera.h"

namespace lambent::render {

struct Mark {
  Vec3 from, to;  ///< of a line; the same place twice: a dot
  Vec3 normal;    ///< unit, of the surface there
  Rgb color;      ///< radiance
  Vec2 radii;     ///< pixels, at `from` and at `to`
};

struct MarkView {
  scene::Camera camera;  ///< where the surface's own axes have it
  Mat4 clipFromSurface = Mat4::Identity();
  float brightness = 1.0f;  ///< what colours are multiplied with
};

class GlMarks {
 public:
  static Result<GlMarks> make(std::span<const Mark> marks);

  /// Into a framebuffer that holds the surface: linear radiance where its depth is not nearer.
  /// Alpha becomes 1, so that no air stands before them; depth stays.
  void draw(GLuint framebuffer, int width, int height, const MarkView& view) const;

 private:
  Buffer marks_;
  int count_ = 0;
  VertexArray noAttributes_;
  Program program_;
};

}  // namespace lambent::render
