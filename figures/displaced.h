// Meso-structure as real geometry: a patch carried over a parametric surface, triangle by triangle,
// for the path tracer to look at.
#pragma once

#include <functional>

#include "lambent/meso/patch.h"

namespace lambent::figures {

/// A place of a parametric surface. The patch's +x runs along ∂P/∂u, its +y along −∂P/∂v, its +z
/// along the normal, as a bi-scale mesh with its own UVs has it.
struct SurfacePlace {
  Vec3d position, normal;
  double scale = 1.0;  ///< metres of the surface that a metre of the patch covers
};
/// u, v: 0 … 1 over the surface, and somewhat beyond, for what reaches over a patch's border.
using ParametricSurface = std::function<SurfacePlace(double u, double v)>;

/// tilesU by tilesV periods of the patch over u, v in [0, 1]. The point (x, y, z) of the patch goes
/// to P(u, v) + N(u, v)·(z − middle)·scale(u, v) with (tilesU u, −tilesV v) = (x, y)/period, so
/// that the surface lies midway in the patch's depth, where an RTT is sampled. Normals go by the
/// inverse transpose of the map's Jacobian.
scene::Scene displaced(const meso::Patch& patch, const ParametricSurface& surface, int tilesU,
                       int tilesV);

}  // namespace lambent::figures
