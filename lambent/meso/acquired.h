// RTTs from measured patches: a bidirectional texture function (BTF) as pictures → RTT.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lambent/meso/btf_table.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/transfer/field.h"

namespace lambent::meso {

/// Values at a few (view, light) pairs, filled in between: a linear combination of the samples that
/// is exact at each of them, constant where all are equal, and continuous; smooth except at the
/// samples.
class BtfInterpolation {
 public:
  /// At least one sample; no two with the same view and light.
  explicit BtfInterpolation(std::span<const BtfSample> samples);
  ~BtfInterpolation();
  BtfInterpolation(BtfInterpolation&&) noexcept;

  /// One weight for each sample; they sum to 1.
  std::vector<double> weights(const Vec3& view, const Vec3& light) const;
  /// Σ_k factor_k · weights(view, light_k), at the price of one look-up.
  std::vector<double> weights(const Vec3& view, std::span<const Vec3> lights,
                              std::span<const double> factors) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct AcquiredOptions {
  int width = 64, height = 64;              ///< positions of the RTT, 1 … 1024
  int views = 8;                            ///< a side, 1 … 32
  int bands = 5;                            ///< of the light, 1 … 10
  int polarLights = 8, azimuthLights = 16;  ///< eq. (5) is summed over a grid of lights, 1 … 64
  Vec2 size = Vec2(0.1f, 0.1f);             ///< metres of the surface that the pictures show
  /// The number that a white diffuse surface facing the light has in the pictures (after sRGB
  /// decoding, for PNG): pictures hold π/white times the radiance under unit irradiance.
  float white = 1.0f;
  /// Bytes that reading the pictures may take, one at a time; nothing: as much as pictures of their
  /// size may need (see file/budget.h).
  std::optional<std::uint64_t> memoryLimit = {};
  int threads = 0;  ///< 0: as many as the machine has. No effect on the result
};

/// Builds an RTT from a folder of rectified pictures (every pixel the same place of the patch in
/// all of them, top row at +y; PNG, JPEG, HDR or EXR, of one size) and its table. Measured patches
/// seldom tile: pictures are taken as they are, and a warning "picture-seam" says how much the
/// borders jump.
///
/// BadInput: tables as readBtfTable says, pictures that are missing, unreadable, of another size
/// than the first, or not finite; fewer than 8 samples, or more than 8192; two samples of one view
/// and light. A warning "sparse-lights" or "sparse-views" names the widest gap above 40 degrees.
Result<WithFindings<transfer::SimulatedRtt>> acquireRtt(const std::filesystem::path& folderOrTable,
                                                        const AcquiredOptions& options,
                                                        const Progress& progress);

}  // namespace lambent::meso
