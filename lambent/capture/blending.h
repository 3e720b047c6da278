// How light that was sampled at a few points blends over an object (sloan2002precomputed §6.1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/math/types.h"

namespace lambent::capture {

/// The samples that a point of the surface takes its light from: L_p = Σ weight_k · L_{sample_k}.
/// Weights are ≥ 0 and sum to 1; unused places have weight 0.
struct BlendWeights {
  std::array<std::uint16_t, 4> sample{};
  std::array<float, 4> weight{1.0f, 0.0f, 0.0f, 0.0f};
};

/// [mesh][receiver], as the meshes of an asset and their receivers. A mesh without receivers
/// (a mirror) has none.
struct Blending {
  std::vector<Vec3> samples;  ///< where light is sampled, in the asset's frame
  std::vector<std::vector<BlendWeights>> meshes;
};

/// The weights of the up to four nearest samples at each point. A weight falls to zero where its
/// sample is about to leave the nearest four, so that light has no seams. With one sample it is 1
/// everywhere; at a sample itself that sample's is 1. 1 … 65535 samples.
std::vector<BlendWeights> blendWeights(std::span<const Vec3> points, std::span<const Vec3> samples);

/// `samples` blended over the receivers of every mesh of an asset.
Blending blendOver(const asset::Asset& asset, std::vector<Vec3> samples);

}  // namespace lambent::capture
