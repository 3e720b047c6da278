// What the background shows, and mirrors where they see nothing nearer (gl_mirrors.h), on the GPU
// (shaders/environment.glsl).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "lambent/light/environment.h"
#include "lambent/render/gl_objects.h"

namespace lambent::render {

/// What a program that shows an environment includes: shaders/environment.glsl, and where its maps
/// lie.
std::string environmentSource();

/// As in shaders/environment.glsl.
inline constexpr std::size_t kMostDiscs = 16;

class GlEnvironment {
 public:
  /// Its image (or the first of several) and up to kMostDiscs discs are shown as they are, its sky
  /// (or the first) by a map of 512×256 that ends at a sharp horizon; what else it has is gathered
  /// in a picture of 2048×1024 (smooth lights: 512×256). Uploads what it must: an environment whose
  /// image or sky is there already costs next to nothing, turned or with other discs.
  Status set(const light::Environment& environment, int largestTexture);
  /// For the program that draws next, which includes environment.glsl.
  void bind(const Program& program, const Mat3& environmentFromWorld) const;

 private:
  light::Environment::Parts parts_;                     ///< without what is in rest_
  std::shared_ptr<const image::Image> uploaded_;        ///< what picture_ holds
  std::shared_ptr<const light::Skylight> skyUploaded_;  ///< what sky_ holds
  Texture picture_, rest_, sky_;
};

}  // namespace lambent::render
