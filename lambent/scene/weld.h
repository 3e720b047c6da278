// Vertices of equal position taken as one.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// For every vertex the number of its position, from 0 on. −0 equals +0.
std::vector<std::uint32_t> weldPositions(const Mesh& mesh);

}  // namespace lambent::scene
