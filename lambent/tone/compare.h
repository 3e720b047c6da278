// How far a picture is from another as a person sees them: the figures behind "lambent compare".
#pragma once

#include "lambent/image/compare.h"
#include "lambent/image/image.h"
#include "lambent/report/result.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::tone {

struct CompareOptions {
  /// Both pictures are display-referred already (linear light in [0, 1], as read from PNG): FLIP
  /// takes them as they are, and PSNR is of their 8-bit codes, with peak 255, as programs that
  /// compare PNG pictures have it (image::psnrOf). Otherwise they are scene-referred: FLIP sees them
  /// exposed and tone-mapped as below, and PSNR's peak is the reference's largest channel.
  bool displayReferred = false;
  float exposureEv = 0.0f;
  Curve curve = Curve::Filmic;
  /// How the pictures are looked at, for FLIP: 67 is a 0.7 m wide 3840-pixel screen from 0.7 m.
  float pixelsPerDegree = 67.0f;
};

/// BadInput if the sizes differ or the pictures are empty.
Result<image::Comparison> compare(const image::Image& test, const image::Image& reference,
                                  const CompareOptions& options = {});

}  // namespace lambent::tone
