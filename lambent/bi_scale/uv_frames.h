// Tangent frames of a mesh whose own UVs place the patch: parametric surfaces.
#pragma once

#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::bi_scale {

/// One unit tangent per vertex along ∂P/∂u, at right angles to the normal. The patch's +y then lies
/// along normal × tangent, which is −∂P/∂v where UVs are laid out as glTF wants them (v downwards,
/// not mirrored). BadInput if there are no UVs; a finding counts triangles whose UVs are mirrored
/// ("mirrored-uvs": the patch's relief would be turned inside out there) or cover no area
/// ("degenerate-uvs").
Result<WithFindings<std::vector<Vec3>>> uvTangents(const scene::Mesh& mesh);

/// Metres of the surface that a unit of UV covers, along u and along v, in the mean over the area.
Vec2 metresPerUv(const scene::Mesh& mesh);

}  // namespace lambent::bi_scale
