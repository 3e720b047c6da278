// What texels show that lie beside a chart's border: the surface beyond it.
#pragma once

#include <vector>

#include "lambent/atlas/welded_surface.h"
#include "lambent/transport/receivers.h"

namespace lambent::texel_layout {

/// The surface of a mesh's triangles, which hangs together where it is smooth: across edges at
/// which shading normals and colours of both sides agree.
atlas::WeldedSurface smoothSurface(const scene::Mesh& mesh);

/// For every texel of a size×size grid that look-ups along a border reach and no triangle holds. A
/// border is an edge whose two sides lie apart in the square, or one of a single triangle. Where
/// the surface goes on across it, the texel shows the place that lies as far beyond the edge, along
/// the shortest way over the surface, as the texel beside it; light that is linear there is then
/// the same on both sides of the border. Elsewhere, and where that way ends, it shows the last
/// place before: at a crease the border itself. `mesh` is laid out by its texel UVs with gutters of
/// two texels, `surface` is smoothSurface() of it.
std::vector<transport::TexelBeyond> beyondBorders(const scene::Scene& scene, std::uint32_t mesh,
                                                  const atlas::WeldedSurface& surface, int size);

}  // namespace lambent::texel_layout
