// The surfaces of a scene that emit light, as something to draw from.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::reference {

/// Points of emitting fronts, drawn in proportion to what they emit.
class Emitters {
 public:
  /// Keeps a reference: the scene must outlive it.
  explicit Emitters(const scene::Scene& scene);
  bool empty() const { return triangles_.empty(); }

  struct Sample {
    Vec3 position;
    Vec3 normal;  ///< unit, by the triangle's winding
    Rgb emission;
    float coverage;  ///< share of the surface that is there, [0, 1]
  };
  /// For a pair and a number in [0, 1), all uniform. There must be emitters.
  Sample sample(const Vec2& place, float choice) const;
  /// The density, sr⁻¹, with which sample() draws the direction to a point of an emitter, as seen
  /// at a distance under an angle of that cosine with its normal; infinite from behind and edge-on.
  float pdf(const Rgb& emission, float distance, float cosine) const;

 private:
  struct Triangle {
    Vec3 corner, edge1, edge2, normal;
    Rgb emission;
    std::uint32_t mesh, triangle;
  };
  const scene::Scene& scene_;
  std::vector<Triangle> triangles_;
  std::vector<double> cumulative_;  ///< Σ of area times mean emission up to and with a triangle
};

}  // namespace lambent::reference
