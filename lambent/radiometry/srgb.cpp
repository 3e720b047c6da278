#include "lambent/radiometry/srgb.h"

#include <cmath>

namespace lambent::radiometry {

float srgbEncode(float linear) {
  // 0.0031308 is the rounded crossing of the standard; the step it leaves is 2e-8.
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float srgbDecode(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace lambent::radiometry
