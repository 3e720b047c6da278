// How far a picture is from another: the figures behind "lambent compare".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/radiometry/tone.h"
#include "lambent/report/result.h"

namespace lambent::image {

struct CompareOptions {
  /// Both pictures are display-referred already (linear light in [0, 1], as read from PNG): FLIP
  /// and PSNR take them as they are, with peak 1. Otherwise they are scene-referred: FLIP sees them
  /// exposed and tone-mapped as below, and PSNR's peak is the reference's largest channel.
  bool displayReferred = false;
  float exposureEv = 0.0f;
  radiometry::ToneCurve curve = radiometry::ToneCurve::Filmic;
  /// How the pictures are looked at, for FLIP: 67 is a 0.7 m wide 3840-pixel screen from 0.7 m.
  float pixelsPerDegree = 67.0f;
};

/// Over all pixels and channels where both pictures are finite; t is the picture under test, r the
/// reference. Alpha is not compared.
struct Comparison {
  Rgb bias = Rgb::Zero();   ///< mean of t − r, per channel
  double meanBias = 0;      ///< of the three channels
  double relativeBias = 0;  ///< Σ (t − r) / Σ r; 0 if equal, infinite where only r is black
  double rmse = 0;          ///< √ mean (t − r)²
  double relativeRmse = 0;  ///< √ (Σ (t − r)² / Σ r²); infinite where only the reference is black
  double relativeMse = 0;  ///< mean (t − r)² / (r² + 0.01) (rousselle2011adaptive)
  double psnr = 0;         ///< 10 log₁₀ (peak² / mean (t − r)²), dB; infinite if equal
  double psnrPeak = 1;     ///< the peak that it presumes
  double largest = 0;      ///< largest |t − r|
  double flip = 0;         ///< mean of the FLIP map, 0 … 1; not finite pixels count as black
  std::uint64_t nonFinitePixels = 0;  ///< left out of all but FLIP
};

/// BadInput if the sizes differ or the pictures are empty.
Result<Comparison> compare(const Image& test, const Image& reference,
                           const CompareOptions& options = {});

/// The same of any radiances, one beside the other (baked receivers, the covered pixels of two
/// pictures), without FLIP. BadInput if none is finite in both. Asserts on equal lengths.
Result<Comparison> compare(std::span<const Rgb> test, std::span<const Rgb> reference);

/// |t − r| · scale per channel: the picture of an error. Asserts on equal sizes.
Image difference(const Image& test, const Image& reference, float scale);

/// A picture of values in [0, 1] from black over violet and orange to pale yellow, even in
/// lightness (after the CC0 map "magma"); linear RGB for a PNG. NaN shows as green.
Image colourMap(const std::vector<float>& values, int width, int height);

}  // namespace lambent::image
