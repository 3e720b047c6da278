// The texts of shaders/ and shaders/opengl/, built into the library.
#pragma once

#include <string_view>

namespace lambent::render {

/// By file name, as in "sh.glsl"; empty if there is none.
std::string_view shaderSource(std::string_view name);

}  // namespace lambent::render
