// Colours of vertices and faces, however a file counts them.
#pragma once

#include <span>

#include "lambent/math/types.h"
#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// What white is counted as in colours that came as floats: 1; 255 or 65535 where some are beyond 2,
/// or beyond 1 and all of them whole. What is below 0 or not finite does not count.
float whiteOf(std::span<const Rgb> colors);
/// As whiteOf() for integers of more than 8 bits, whose width does not tell: 255 if none is beyond
/// it, else 65535.
float whiteOfIntegers(std::span<const Rgb> colors);

/// The finding for colours whose white is 255 or more in a file that should count to 1.
void noteWhite(float white, Diagnosis& diagnosis);

/// sRGB, counted to `white` → linear.
Rgb linearColor(const Rgb& color, float white);

}  // namespace lambent::scene_io
