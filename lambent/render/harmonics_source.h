// shaders/sh.glsl written out for a number of bands.
#pragma once

#include <string>

namespace lambent::render {

/// kCoefficients and harmonics(), the same numbers as sh.glsl's by the same recurrences, without
/// loops. Written out they brought a glossy frame of 512×512 on a CPU's OpenGL from 181 ms of
/// processor time to 57 (llvmpipe, November 2026). 1 … 10 bands.
std::string harmonicsSource(int bands);

}  // namespace lambent::render
