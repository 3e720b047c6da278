// A mesh's own UVs as an atlas, where they are fit for one.
#pragma once

#include <optional>

#include "lambent/atlas/atlas.h"
#include "lambent/atlas/welded_surface.h"

namespace lambent::atlas {

/// The mesh as it is, with the charts that its UVs make, or nothing and a finding that says why:
/// - no-uvs: there are none.
/// - uvs-unsound: outside of the square, or overlapping (scene::checkUvs at options.size).
/// - uvs-collapsed: triangles with area on the surface have none in the square.
/// - uvs-without-gutter: two charts share a texel, which can only tell of one of them.
/// UVs that are taken although bilinear look-ups would mix charts get a note, uvs-narrow-gutter.
WithFindings<std::optional<Atlas>> atlasOfOwnUvs(const scene::Mesh& mesh,
                                                 const WeldedSurface& surface,
                                                 const AtlasOptions& options);

}  // namespace lambent::atlas
