// The transfer functions of sRGB: linear light ⇄ what files and screens hold.
#pragma once

namespace lambent::radiometry {

float srgbEncode(float linear);  ///< IEC 61966-2-1
float srgbDecode(float encoded);

}  // namespace lambent::radiometry
