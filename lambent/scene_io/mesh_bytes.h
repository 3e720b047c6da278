// What a mesh takes in memory, for the budget of the file that it comes from.
#pragma once

#include <cstdint>

#include "lambent/scene/scene.h"

namespace lambent::scene_io {

inline std::uint64_t bytesOf(const scene::Mesh& mesh) {
  std::uint64_t others = 0;
  for (const scene::VertexNumbers& numbers : mesh.others)
    others += numbers.values.size() * sizeof(float);
  return others + mesh.positions.size() * sizeof(Vec3) + mesh.normals.size() * sizeof(Vec3) +
         (mesh.uvs.size() + mesh.texelUvs.size()) * sizeof(Vec2) +
         mesh.colors.size() * sizeof(Rgb) + mesh.alphas.size() * sizeof(float) +
         mesh.triangles.size() * sizeof(scene::Triangle);
}

}  // namespace lambent::scene_io
