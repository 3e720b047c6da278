// How far one set of radiances is from another: numbers for pictures and for baked receivers alike.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lambent/image/image.h"
#include "lambent/math/types.h"

namespace lambent::compare {

/// All over pixels (or receivers) and channels alike, with a the truth and b what is judged.
struct Metrics {
  std::size_t count = 0;      ///< pixels or receivers compared
  Rgb bias = Rgb::Zero();     ///< mean(b − a) per channel, radiance
  double relativeBias = 0.0;  ///< mean(b − a) / mean(a)
  double rmse = 0.0;          ///< √mean((b − a)²), radiance
  double relativeRmse = 0.0;  ///< √(Σ(b − a)² / Σa²)
  double relativeMse = 0.0;   ///< mean((b − a)² / (a² + ε)), ε = 1% of mean(a)²
  double worst = 0.0;         ///< max |b − a|, radiance
};

/// truth and judged have the same size; pixels where either is not finite are a caller's mistake.
Metrics measure(std::span<const Rgb> truth, std::span<const Rgb> judged);
/// Over the pixels that are covered (alpha above 0) in either picture; both of the same size.
Metrics measure(const image::Image& truth, const image::Image& judged);

/// Peak signal-to-noise ratio in dB of two developed pictures (linear in [0, 1]), after sRGB
/// encoding, peak 1; infinite for equal ones.
double psnr(const image::Image& truth, const image::Image& judged);

}  // namespace lambent::compare
