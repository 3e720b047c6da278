// Functions of shaders, called with numbers, for the tests of render.
#pragma once

#include <string>
#include <vector>

namespace lambent::render::test {

/// Runs `body`, a piece of a compute shader that turns inputs[p][0 … 3] into outputs[p] (vec4s
/// all), on every input: 16 floats in, 4 out. `parts` stand before it. A context must be current.
std::vector<float> onGpu(const std::string& parts, const std::string& body,
                         const std::vector<float>& inputs);

}  // namespace lambent::render::test
