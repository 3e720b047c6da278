// Base-colour textures on the GPU (shaders/base_color.glsl).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "lambent/render/gl_objects.h"
#include "lambent/scene/coverage.h"

namespace lambent::render {

class GlBaseColors {
 public:
  /// `scene` must outlive it.
  explicit GlBaseColors(const scene::Scene& scene)
      : scene_(&scene), passings_(scene::passingsOf(scene)) {}

  /// Uploads the texture of a mesh's material, if it has one that is not there yet. Due for every
  /// mesh before anything is drawn.
  Status add(std::uint32_t mesh, int largestTexture);
  /// What every draw that shows base colours shares.
  void bindTable() const;
  /// For the program that draws a mesh next.
  void bind(const Program& program, std::uint32_t mesh) const;

  /// Whether a mesh may be there in parts alone.
  bool hasGaps(std::uint32_t mesh) const { return passings_[mesh] != scene::Passing::Nothing; }
  /// For a program that holds coverage.glsl.
  void bindCoverage(const Program& program, std::uint32_t mesh, int sample) const;

 private:
  /// Its index, or −1.
  int textureOf(std::uint32_t mesh) const;

  const scene::Scene* scene_;
  std::vector<scene::Passing> passings_;
  std::map<int, Texture> textures_;  ///< by index into the scene's
  Buffer srgbTable_;                 ///< 256 floats: what bytes decode to
};

}  // namespace lambent::render
