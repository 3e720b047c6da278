// Air between the eye and surfaces, on the GPU (shaders/aerial_perspective.glsl).
#pragma once

#include <string>

#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_sun_map.h"
#include "lambent/render/gl_view.h"
#include "lambent/shade/air.h"

namespace lambent::render {

/// What a program that looks through the air includes: shaders/phase_function.glsl,
/// aerial_perspective.glsl, opengl/air_table.glsl, air_texels.glsl and air_behind.glsl; with shafts of
/// light shafts.glsl too.
std::string airSource(bool shafts);

class GlAir {
 public:
  /// Uploads the table: 492 KB of one of the default size.
  static Result<GlAir> make(const shade::Air& air, int largestTexture);
  /// Whether set() can make another air of it: a table of as many nodes, with or without shafts as
  /// this one.
  bool takes(const shade::Air& air) const;
  /// Uploads the table, if it is another.
  Status set(const shade::Air& air);
  bool hasShafts() const { return air_.shafts.has_value(); }
  /// For the program that is used next, which includes airSource(hasShafts()). With shafts of light
  /// there must be view.shafts and, of view.sun, a map.
  void bind(const Program& program, const GlView& view, const GlSunMap* sunMap) const;
  /// … which includes airSource(false).
  void bindTable(const Program& program) const;

 private:
  explicit GlAir(const shade::Air& air) : air_(air) {}
  void upload() const;

  shade::Air air_;
  Texture table_;
};

}  // namespace lambent::render
