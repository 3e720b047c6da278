// How texture coordinates lie on a triangle.
#pragma once

#include <cstdint>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// World space, metres: a step of 1 in u, or v, over a triangle; zero where its uvs are degenerate.
struct UvSteps {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
};
UvSteps uvSteps(const Mesh& mesh, std::uint32_t triangle);

}  // namespace lambent::scene
