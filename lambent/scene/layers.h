// Layers: meshes that lie on others, each of their triangles in the place of one of those (its
// corners at the same positions, in the same sequence or turned). A layer is there as its alpha
// says. One is seen before what it lies on, and a later mesh before an earlier one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// A base colour whose alpha is channel 0 … 2 of a mask, as the mask's code values say it; both
/// lie over the same UVs. Null: white.
Texture masked(const Texture* color, const Texture& mask, int channel);

/// The triangles of a mesh with UVs where a texture has any alpha, by their numbers.
std::vector<std::uint32_t> trianglesWithAlpha(const Mesh& mesh, const Texture& texture);

/// Leaves of a mesh these triangles, in their sequence, and what vertices they need: it becomes a
/// layer of what it was. Returns which vertices those were.
std::vector<std::uint32_t> makeLayer(Mesh& mesh, const std::vector<std::uint32_t>& triangles);

/// Finds what lies on a place.
class Layers {
 public:
  /// Keeps a reference: the scene must outlive it.
  explicit Layers(const Scene& scene);

  bool any() const { return !all_.empty(); }
  struct Place {
    std::uint32_t mesh = 0, triangle = 0;
    float u = 0.0f, v = 0.0f;  ///< the corners weigh (1−u−v, u, v)
  };
  /// The same place of every layer that lies on a triangle of another mesh, uppermost first.
  std::vector<Place> above(std::uint32_t mesh, std::uint32_t triangle, float u, float v) const;

 private:
  struct Entry {
    std::array<Vec3, 3> corners;  ///< from the least on
    std::uint32_t mesh = 0, triangle = 0;
    int first = 0;  ///< the triangle's own number of corners[0]
  };
  const Scene& scene_;
  std::vector<Entry> all_;  ///< by place, and there the uppermost first
};

}  // namespace lambent::scene
