// From scene-referred linear RGB to what a screen shows.
#pragma once

#include <span>

#include "lambent/math/types.h"

namespace lambent::radiometry {

/// Rec. 709 luminance weights.
float luminance(const Rgb& linear);

/// A filmic curve, per channel: linear near black, a shoulder that takes 16× white to below 1.
/// Shared with the shaders, which must agree to 1/255:
///
///   vec3 filmic(vec3 c) {
///     vec3 x = clamp(c, 0.0, 65504.0);
///     return x * (1.0 + 2.0 * x) / (1.0 + 2.0 * x * (1.0 + x));
///   }
///
/// 0.18 → 0.172, 1 → 0.6, 16 → 0.969. Negative values and NaN become 0.
Rgb filmic(const Rgb& linear);

enum class ToneCurve { Linear, Filmic };

/// exposure in EV (a factor 2^EV), then the curve; the result is linear in [0, 1] for sRGB
/// encoding. In place.
void toneMap(std::span<Rgb> pixels, float exposureEv, ToneCurve curve);

/// The same for a picture: anything with `pixels`, that is image::Image. A template, so that this
/// room stands below image, which needs the sRGB curve.
template <class Picture>
Picture toneMap(Picture scene, float exposureEv, ToneCurve curve) requires requires {
  std::span<Rgb>(scene.pixels);
}
{
  toneMap(std::span<Rgb>(scene.pixels), exposureEv, curve);
  return scene;
}

float srgbEncode(float linear);  ///< IEC 61966-2-1
float srgbDecode(float encoded);

}  // namespace lambent::radiometry
