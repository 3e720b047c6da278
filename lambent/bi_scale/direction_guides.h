// Which way a patch is to lie here and there: by curves, by a picture.
#pragma once

#include <span>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/tangent_field.h"

namespace lambent::bi_scale {

/// World space, metres; two points or more.
using Curve = std::vector<Vec3>;

/// The patch's +x follows the nearest curve: at a distance d from it with the weight (1 − d/reach)²,
/// and beyond `reach` metres as smoothly as can be.
struct CurveSteering {
  std::vector<Curve> curves;
  float reach = 0.0f;  ///< 0: a tenth of the mesh's diagonal
};

/// A picture over the mesh's own UVs: red and green, from 0 to 1, are −1 to 1 along the picture's
/// right and up. That is the patch's +x, and its length, to 1, the weight; grey is no opinion.
struct PictureSteering {
  scene::Texture picture;
};

/// One for each vertex.
std::vector<synthesis::Guide> guidesBy(const CurveSteering& steering, const scene::Mesh& mesh);
/// BadInput where the mesh has no UVs.
Result<std::vector<synthesis::Guide>> guidesBy(const PictureSteering& steering,
                                               const scene::Mesh& mesh);

}  // namespace lambent::bi_scale
