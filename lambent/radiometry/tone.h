// From scene-referred linear RGB to what a screen shows.
#pragma once

#include "lambent/image/image.h"
#include "lambent/math/types.h"

namespace lambent::radiometry {

/// Rec. 709 luminance weights.
float luminance(const Rgb& linear);

/// A filmic curve, per channel: linear near black, a shoulder that takes 16× white to below 1.
/// Shared with the shaders, which must agree to 1/255.
Rgb filmic(const Rgb& linear);

enum class ToneCurve { Linear, Filmic };

/// exposure in EV (a factor 2^EV), then the curve; the result is linear in [0, 1] for sRGB
/// encoding.
image::Image toneMap(const image::Image& scene, float exposureEv, ToneCurve curve);

float srgbEncode(float linear);  ///< IEC 61966-2-1
float srgbDecode(float encoded);

}  // namespace lambent::radiometry
