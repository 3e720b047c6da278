// Air between the eye and surfaces, on the GPU (shaders/aerial_perspective.glsl).
#pragma once

#include <string>

#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_sun_map.h"
#include "lambent/render/gl_view.h"
#include "lambent/shade/air.h"

namespace lambent::render {

/// What a program that looks through the air includes: shaders/phase_function.glsl,
/// aerial_perspective.glsl, opengl/air_table.glsl and air_texels.glsl; with shafts of light shafts.glsl too.
std::string airSource(bool shafts);

class GlAir {
 public:
  /// Uploads the table: 492 KB of one of the default size.
  static Result<GlAir> make(const shade::Air& air, int largestTexture);
  /// What programs include.
  std::string source() const { return airSource(air_.shafts.has_value()); }
  /// For the program that draws next, which includes source(). With shafts of light there must be
  /// view.shafts and, of view.sun, a map.
  void bind(const Program& program, const GlView& view, const GlSunMap* sunMap) const;
  /// With shafts: what they take from the background, where nothing is drawn yet. A vertex array must
  /// be bound.
  void drawCurtain(const GlView& view, const GlSunMap* sunMap) const;

 private:
  explicit GlAir(const shade::Air& air) : air_(air) {}

  shade::Air air_;
  Texture table_;
  Program curtain_;  ///< of shafts
};

}  // namespace lambent::render
