// How a surface scatters light towards a viewer: the Material of lambent/scene/scene.h as values,
// densities and draws.
#pragma once

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::reference {

/// Whether the surface hides what is behind it from its glossy lobe. Unshadowed transfer T_GU does
/// not (sloan2002precomputed §4.2 integrates over the whole sphere).
enum class Horizon { Blocks, Open };

class Scattering {
 public:
  /// `toViewer` is a unit vector; the point is no mirror.
  Scattering(const scene::SurfacePoint& point, const Vec3& toViewer,
             Horizon horizon = Horizon::Blocks);

  /// Exit radiance per radiance · ds from a direction: ρ/π max(0, N·s) + k G(s, R), the latter 0
  /// behind the shading normal unless the horizon is open.
  Rgb value(const Vec3& direction) const;
  /// The density with which draw() draws, sr⁻¹. The glossy lobe also draws directions behind the
  /// normal, whose value is 0.
  float pdf(const Vec3& direction) const;
  Vec3 draw(const Vec2& u, float chooseLobe) const;
  bool black() const { return black_; }

 private:
  Vec3 normal_, reflected_;
  Rgb diffuse_, glossy_;
  float exponent_;
  Horizon horizon_;
  float diffuseShare_ = 1.0f;  ///< probability of drawing by the cosine
  bool black_ = false;
};

}  // namespace lambent::reference
