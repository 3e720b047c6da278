// How far a picture is from another: the figures behind "lambent compare".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/report/result.h"

namespace lambent::image {

/// Over all pixels and channels where both pictures are finite; t is the picture under test, r the
/// reference. Alpha is not compared.
struct Comparison {
  Rgb bias = Rgb::Zero();   ///< mean of t − r, per channel
  double meanBias = 0;      ///< of the three channels
  double relativeBias = 0;  ///< Σ (t − r) / Σ r; 0 if equal, infinite where only r is black
  double rmse = 0;          ///< √ mean (t − r)²
  double relativeRmse = 0;  ///< √ (Σ (t − r)² / Σ r²); infinite where only the reference is black
  double relativeMse = 0;  ///< mean (t − r)² / (r² + 0.01) (rousselle2011adaptive)
  double psnr = 0;         ///< 10 log₁₀ (peak² / mean (t − r)²), dB; infinite if equal; of
                           ///< 8-bit codes for display-referred pictures (tone::compare)
  double psnrPeak = 1;     ///< the peak that it presumes
  double largest = 0;      ///< largest |t − r|
  double flip = 0;         ///< mean of the FLIP map, 0 … 1; not finite pixels count as black
  std::uint64_t nonFinitePixels = 0;  ///< left out of all but FLIP
};

/// Of any radiances, one beside the other (baked receivers, the covered pixels of two pictures),
/// without FLIP: tone::compare compares pictures as they are seen. BadInput if none is finite in
/// both. Asserts on equal lengths.
Result<Comparison> compare(std::span<const Rgb> test, std::span<const Rgb> reference);

/// |t − r| · scale per channel: the picture of an error. Asserts on equal sizes.
Image difference(const Image& test, const Image& reference, float scale);

/// A picture of values in [0, 1] from black over violet and orange to pale yellow, even in
/// lightness (after the CC0 map "magma"); linear RGB for a PNG. NaN shows as green.
Image colourMap(const std::vector<float>& values, int width, int height);

}  // namespace lambent::image
