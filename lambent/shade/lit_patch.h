// A mesh with meso-structure after the light was applied at the macro scale, and its evaluation at
// places of its surface. What exitRadiance and the CPU picture share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "lambent/scene/scene.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/patch_place.h"
#include "lambent/shade/rtt_pyramid.h"
#include "lambent/shade/showing.h"

namespace lambent::shade {

/// The pyramids of an asset's textures, each made when it is first asked for.
class RttPyramids {
 public:
  /// Without `filter`, level 0 alone.
  RttPyramids(const transfer::EncodedField& field, bool filter) : field_(field), filter_(filter) {}
  std::shared_ptr<const RttPyramid> of(int rtt);

 private:
  const transfer::EncodedField& field_;
  bool filter_;
  std::map<int, std::shared_ptr<const RttPyramid>> made_;
};

/// Light as rttStride(bands) numbers a receiver, coefficient after coefficient, each R, G, B: from
/// [receiver][3][bands²].
std::vector<float> inRttLayout(const std::vector<float>& light, int bands);

class LitPatch {
 public:
  /// Of a mesh with meso-structure. The asset must outlive it, and fit together (asset::faultOf).
  LitPatch(const asset::Asset& asset, std::uint32_t mesh, std::shared_ptr<const RttPyramid> pyramid,
           const sh::RgbCoefficients& light, const Showing& showing);

  /// Exit radiance (eq. 4) of a place of a triangle towards the viewer, without the base colour,
  /// which multiplies it. `width`: metres that the sub-sample sees across its ray.
  Rgb at(std::uint32_t triangle, float u, float v, const scene::SurfacePoint& point,
         const Vec3& toViewer, float width) const;
  /// … of a receiver, at the nearest position of the patch.
  Rgb atReceiver(std::uint32_t receiver, const Vec3& toViewer) const;

 private:
  const scene::Mesh& mesh_;
  const transfer::BiScale<transfer::Numbers>& biScale_;
  Vec2 rttSize_;
  std::shared_ptr<const RttPyramid> pyramid_;
  bool viewDependent_, filter_;
  std::vector<float> light_;              ///< [receiver][rttStride]
  std::vector<PatchGradient> gradients_;  ///< of triangles, if there is no id map
};

}  // namespace lambent::shade
