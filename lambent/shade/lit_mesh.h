// A mesh's transfer after the light was applied, and its evaluation between receivers. What
// exitRadiance and the CPU picture share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/scene/scene.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/lobe.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/showing.h"
#include "lambent/transfer/field.h"

namespace lambent::shade {

/// Up to four receivers and their weights, which sum to 1: the corners of a triangle, or the four
/// texels around a point.
struct ReceiverWeights {
  std::array<std::uint32_t, 4> index{};
  std::array<float, 4> weight{};
  int count = 0;

  static ReceiverWeights one(std::uint32_t index) { return {{index}, {1.0f}, 1}; }
  static ReceiverWeights ofTriangle(const scene::Triangle& triangle, float u, float v) {
    return {{triangle[0], triangle[1], triangle[2]}, {1.0f - u - v, u, v}, 3};
  }
  /// Bilinear between texel centres, clamped to the edge. uv as glTF has it; row 0 at v = 0.
  static ReceiverWeights ofTexels(int width, int height, const Vec2& uv);
};

struct LitMesh {
  std::vector<float> diffuse;  ///< exit radiance M · L, [receiver][3], or empty
  bool albedoOutside = false;  ///< the diffuse part still lacks the base colour
  std::vector<float> lobe;     ///< α_i G_i (M L)_i · k, [receiver][coefficient][3], or empty
  int lobeBands = 0;
  LobeGain gain;

  Rgb diffuseAt(const ReceiverWeights& at) const;
  /// Glossy exit radiance (eq. 12) towards a viewer, without the base colour. Directions are unit.
  Rgb glossyAt(const ReceiverWeights& at, const Vec3& toViewer, const Vec3& normal) const;
};

/// What a response that was simulated, or is made up, under a kind sends out.
LitMesh lightMesh(const transfer::SurfaceResponse<transfer::Numbers>& response, transfer::Kind kind,
                  const sh::RgbCoefficients& light, const Showing& showing);
/// A bare surface as `showing` has it, or black. Under a sharp Sun without what falls from it on
/// the diffuse surface directly: that is the caller's to add (sharp_sun.h).
LitMesh lightSurface(const asset::Asset& asset, std::uint32_t mesh,
                     const sh::RgbCoefficients& light, const Showing& showing,
                     const std::optional<SharpSun>& sun);

/// v mirrored about the normal; both unit, both pointing away from the surface.
inline Vec3 mirrored(const Vec3& v, const Vec3& normal) {
  return 2.0f * normal.dot(v) * normal - v;
}

/// Base colour (texture × vertex colour, without the material's factors) at every receiver of a
/// mesh; empty if it is white everywhere.
std::vector<Rgb> receiverBaseColors(const scene::Scene& scene, std::uint32_t mesh,
                                    const transfer::Receivers& receivers);

}  // namespace lambent::shade
