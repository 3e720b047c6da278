// The tone curve is our own rational function f(x) = (x + a x²) / (1 + a x + a x²), a = 2, of the
// family that reinhard2002photographic eq. 3 opens (its x/(1+x) is a = 0 and 1 in place of the
// first a below). With equal a above and below the second-order term at black vanishes: f(x) = x −
// a x³ + …, so shadows and midtones keep their contrast, where x/(1+x) has lost 15 % at middle grey
// already. Monotone for a ≥ 1: the numerator of f' is 1 + 2ax + (a² − a)x². It tends to 1, and 1 −
// f(16) = .031 is 4 steps of an 8-bit sRGB picture.
#include "lambent/tone/tone_curve.h"

#include <algorithm>
#include <cmath>

namespace lambent::tone {
namespace {

constexpr float kLargest =
    65504.0f;  // of half floats; beyond, x² would overflow a shader's mediump

// Written so that NaN fails the comparison.
float positive(float x) {
  return x > 0.0f ? std::min(x, kLargest) : 0.0f;
}

float filmicChannel(float value) {
  const float x = positive(value);
  return x * (1.0f + 2.0f * x) / (1.0f + 2.0f * x * (1.0f + x));
}

}  // namespace

Rgb filmic(const Rgb& linear) {
  return Rgb(filmicChannel(linear[0]), filmicChannel(linear[1]), filmicChannel(linear[2]));
}

void toneMap(std::span<Rgb> pixels, float exposureEv, Curve curve) {
  const float factor = std::exp2(exposureEv);
  for (Rgb& pixel : pixels) {
    for (int c = 0; c < 3; ++c) {
      const float exposed = pixel[c] * factor;
      pixel[c] =
          curve == Curve::Filmic ? filmicChannel(exposed) : std::min(positive(exposed), 1.0f);
    }
  }
}

image::Image toneMap(image::Image scene, float exposureEv, Curve curve) {
  toneMap(std::span<Rgb>(scene.pixels), exposureEv, curve);
  return scene;
}

}  // namespace lambent::tone
