// How messages name a mesh.
#pragma once

#include <cstdint>
#include <string>

#include "lambent/scene/scene.h"

namespace lambent::bi_scale {

inline std::string quoted(const scene::Mesh& mesh, std::uint32_t index) {
  return "mesh " + std::to_string(index) + (mesh.name.empty() ? "" : " (\"" + mesh.name + "\")");
}

}  // namespace lambent::bi_scale
