// From scene-referred linear RGB to what a screen shows.
#pragma once

#include <span>

#include "lambent/image/image.h"
#include "lambent/math/types.h"

namespace lambent::tone {

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

enum class Curve { Linear, Filmic };

/// exposure in EV (a factor 2^EV), then the curve; the result is linear in [0, 1] for sRGB
/// encoding. In place.
void toneMap(std::span<Rgb> pixels, float exposureEv, Curve curve);

/// The same for a picture; its alpha stays.
image::Image toneMap(image::Image scene, float exposureEv, Curve curve);

}  // namespace lambent::tone
