// Forms by formula that are hard to lay a patch over: knotted, with limbs and folds, with few
// triangles, with a hole.
#pragma once

#include "lambent/scene/scene.h"

namespace lambent::figures {

/// A tube about a (2, 3) torus knot, about 2.5 m across, closed.
scene::Mesh torusKnot();

/// A four-legged creature with arms' width of limbs, a tail, ears, and folds at its neck and belly,
/// about 2 m long, closed. `cells` along its length: 13 make about 500 triangles, 150 about
/// 70,000.
scene::Mesh creature(int cells);

/// A square of 2 m in the plane y = 0 with a round hole of 0.7 m in the middle, front up; no UVs.
scene::Mesh holedPlane();

}  // namespace lambent::figures
