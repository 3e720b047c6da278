// How much of a surface is there, and what light goes on through it.
#pragma once

#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// What a mesh lets through.
enum class Passing {
  Nothing,  ///< it is whole, whatever its material calls itself
  Holes,    ///< all or nothing, place by place
  Shares,   ///< anything between
};

/// Of every mesh, by what its material, texture and vertices can come to.
std::vector<Passing> passingsOf(const Scene& scene);

/// The share of the surface that is there at a place of a triangle, [0, 1]: what it reflects counts
/// by that.
float coverageAt(const Scene& scene, std::uint32_t mesh, std::uint32_t triangle, float u, float v);

/// The share of the light that goes on straight through, [0, 1].
Rgb passedAt(const Scene& scene, std::uint32_t mesh, std::uint32_t triangle, float u, float v);

}  // namespace lambent::scene
