// Air between the eye and surfaces, on the GPU (shaders/aerial_perspective.glsl).
#pragma once

#include <string>

#include "lambent/render/gl_objects.h"
#include "lambent/shade/air.h"

namespace lambent::render {

/// What a program that looks through the air includes: shaders/phase_function.glsl,
/// aerial_perspective.glsl and opengl/air_table.glsl.
std::string airSource();

class GlAir {
 public:
  /// Uploads the table: 369 KB of one of the default size.
  static Result<GlAir> make(const shade::Air& air, int largestTexture);
  /// For the program that draws next, which includes airSource().
  void bind(const Program& program) const;

 private:
  explicit GlAir(const shade::Air& air) : air_(air) {}

  shade::Air air_;
  Texture table_;
};

}  // namespace lambent::render
