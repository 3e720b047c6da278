// What hides a point of the Sun from a scene: a map of depths, drawn anew for every sub-sample of a
// picture, each for its own point of the disc. So penumbrae come of the disc itself, as wide as
// they are, and the borders of shadows are as smooth as those of surfaces are.
#pragma once

#include "lambent/light/sun.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_view.h"
#include "lambent/scene/scene.h"

namespace lambent::render {

class GlSunMap {
 public:
  /// Texels of a side, where GL takes as many.
  static constexpr int kSide = 2048;

  static Result<GlSunMap> make(int largestTexture);

  /// Draws the map of what stands in `bounds`, as the point of the Sun `sun` looks at it: of what
  /// is seen through `clipFromWorld`, or of all of it (null). drawPieces() draws everything, with
  /// vertices as unlit.vert.glsl has them; what is there in parts alone with gapsProgram(), whose
  /// coverage it binds, the rest with wholeProgram(). Leaves another framebuffer, viewport, depth
  /// test and program than before.
  template <class DrawPieces>
  void draw(const light::SunPoint& sun, const Mat4* clipFromWorld, const scene::Box& bounds,
            DrawPieces drawPieces) {
    begin(sun, clipFromWorld, bounds);
    drawPieces();
    end();
  }
  const Program& wholeProgram() const { return program_; }
  const Program& gapsProgram() const { return gapsProgram_; }
  /// Gives a program that holds sun_shadow.glsl the map.
  void bind(const Program& program) const;
  /// … or air_texels.glsl with shafts of light.
  void bindForShafts(const Program& program) const;

 private:
  void begin(const light::SunPoint& sun, const Mat4* clipFromWorld, const scene::Box& bounds);
  void end() const;

  Texture depth_;
  Framebuffer framebuffer_;
  Program program_, gapsProgram_;
  int side_ = 0;
  Mat3 frameFromWorld_ = Mat3::Identity();
  Mat4 mapFromWorld_ = Mat4::Identity();
  float texel_ = 1, range_ = 1;
};

}  // namespace lambent::render
