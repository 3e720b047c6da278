// What frames are drawn into, the sum of them, and the picture that the sum makes.
#pragma once

#include <compare>
#include <map>

#include "lambent/image/image.h"
#include "lambent/render/gl_air.h"
#include "lambent/render/gl_environment.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_view.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::render {

class GlTarget {
 public:
  static Result<GlTarget> make(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Linear radiance, alpha as shaders/opengl/sample_alpha.glsl says, and depth.
  GLuint framebuffer() const { return framebuffer_.name(); }

  /// Binds the frame to be drawn into: black and without coverage, at the far plane.
  void beginFrame() const;
  /// The sum: nothing.
  void clearSum() const;
  /// What a frame is seen through and before; null: without.
  struct Around {
    const GlEnvironment* background = nullptr;
    const GlAir* air = nullptr;
    const GlSunMap* sunMap = nullptr;  ///< of the air's shafts, if it has any
  };
  /// Makes what addToSum() needs, if it has not been made yet.
  Status prepare(const Around& around);
  /// Adds the frame, through the air, to the sum, and the background where the frame leaves pixels
  /// uncovered.
  void addToSum(const GlView& view, const Around& around);
  /// The mean of `samples` frames: radiance and coverage. Where backgrounds were added, they are
  /// left out.
  Result<image::Image> mean(int samples) const;
  /// The mean over its background as shade::finishPicture, without alpha.
  Result<image::Image> meanOverBackground(int samples) const;
  /// The same onto the whole of a framebuffer of this size, exposed and coded for a screen.
  void show(int samples, GLuint framebuffer, float exposureEv, tone::Curve curve) const;

 private:
  Texture color_, depth_, sum_, behind_;
  Framebuffer framebuffer_;
  VertexArray noAttributes_;
  Program show_;
  struct Kind {
    bool background, air, shafts;
    auto operator<=>(const Kind&) const = default;
  };
  static Kind kindOf(const Around& around);
  std::map<Kind, Program> accumulate_;
  bool cutLast_ = false;  ///< the sum holds what shadows in the air take from the background
  int width_ = 0, height_ = 0;
};

}  // namespace lambent::render
