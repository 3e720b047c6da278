// Encoded transfer · light on the CPU: the oracle for every GPU path.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/aligned_vector.h"
#include "lambent/shade/showing.h"
#include "lambent/transfer/field.h"

namespace lambent::shade {

/// A mesh's diffuse transfer laid out for shading: blocks of 16 receivers, coefficient after
/// coefficient, 16 or 32 bit as encoded (32 where the machine cannot convert).
class DiffuseShader {
 public:
  explicit DiffuseShader(const transfer::Vectors<transfer::Numbers>& vectors);
  /// Exit radiance M · L of every receiver, without the base colour if the mesh keeps it outside
  /// (transfer::Albedo::BaseColor). out: 3 floats for each receiver. One thread.
  void shade(const sh::RgbCoefficients& light, std::span<float> out) const;
  std::size_t receiverCount() const { return receivers_; }

 private:
  std::size_t receivers_ = 0;
  int bands_ = 0, channels_ = 0;
  AlignedVector<float> single_;
  AlignedVector<std::uint16_t> half_;
};

struct ReceiverView {
  std::optional<Vec3> eye;  ///< world position; none: every receiver is seen along its normal
  Showing showing;          ///< receivers are not filtered
};

/// Whole exit radiance of every receiver of a mesh: diffuse and glossy (eq. 12) parts and base
/// colour, not clamped: a light that rings is seen to ring. Empty for a mirror. A light of fewer
/// bands than the asset takes counts as zero beyond; one of more is cut. What is not held is shown
/// as the nearest below that is (kindShown).
std::vector<Rgb> exitRadiance(const asset::Asset& asset, std::uint32_t mesh,
                              const sh::RgbCoefficients& light, const ReceiverView& view = {});

}  // namespace lambent::shade
