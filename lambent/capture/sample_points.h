// Where the light around an object is sampled: a few points that stand for its whole surface
// (sloan2002precomputed §6.1).
#pragma once

#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/scene.h"

namespace lambent::capture {

struct SamplePoints {
  std::vector<Vec3> points;
  /// Mean over the area of the squared distance to the nearest point, metres²: after every step of
  /// Lloyd's at the full number of points, so that it can be seen to fall. The last is the
  /// result's.
  std::vector<double> distortions;
};

/// `count` (1 … 65535) points such that the surface of all meshes is near to one of them in the
/// mean, by vector quantisation: from the centroid of the area, the cell that is worst served is
/// split, until there are enough, and Lloyd's iteration moves all. By area: how finely a region is
/// tessellated does not matter. Fewer points only if the surface has fewer distinct places. The
/// same input gives the same points.
///
/// A point is the centroid of a piece of surface, and so may lie inside of the object. That does no
/// harm: what is sampled there is the light of a world without the object. Asserts that the scene
/// has a triangle of positive area.
SamplePoints samplePoints(const scene::Scene& surface, int count);

}  // namespace lambent::capture
