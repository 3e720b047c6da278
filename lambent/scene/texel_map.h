// A mesh seen from its texture: which place of the surface each texel of a grid over TEXCOORD_0
// shows, and, for texels that show none, the nearest that does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

inline constexpr std::uint32_t kNobody = 0xffffffffu;

/// Texel (x, y) is entry y·width + x; its centre is at ((x + ½)/width, (y + ½)/height).
struct TexelMap {
  int width = 0, height = 0;
  std::vector<std::uint32_t> triangle;  ///< that holds the texel's centre, or kNobody
  std::vector<Vec2> barycentric;  ///< (u, v) of the centre, corners weighing (1−u−v, u, v); zero
                                  ///< where there is none

  std::size_t size() const { return triangle.size(); }
  bool covered(std::size_t texel) const { return triangle[texel] != kNobody; }
};

/// Of several triangles that hold a centre (on a common edge) the first has it. Triangles without
/// area in the square hold none. `mesh` has UVs; what lies outside of the unit square is not seen.
TexelMap texelMap(const Mesh& mesh, int width, int height);

/// For every texel the nearest one for which `full` is not 0, by distance between centres, exactly
/// (of several as near one of them, always the same). kNobody everywhere if none is full.
std::vector<std::uint32_t> nearestFull(int width, int height, std::span<const std::uint8_t> full);

}  // namespace lambent::scene
