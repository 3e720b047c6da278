// Points spread over a surface so that no two of a level stand nearer than the level's radius.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/manifold.h"

namespace lambent::synthesis {

struct SurfaceSample {
  Vec3 position;
  std::uint32_t triangle;
  float u, v;  ///< barycentric: (1−u−v, u, v)
};

struct SurfaceSamples {
  std::vector<SurfaceSample> samples;   ///< level after level; along a space-filling curve in each
  std::vector<std::uint32_t> levelEnd;  ///< coarse to fine
  double area = 0.0;                    ///< m²
};

/// About count / 4^(levels−1), …, count / 4, count samples in nested levels. The surface's sheets
/// do not hinder one another: not those of other components, not the far side of a thin body.
/// `faceNormals`: unit, by winding, one per triangle. Triangles without area get none.
Result<SurfaceSamples> spreadOver(const scene::Mesh& mesh, const Manifold& manifold,
                                  const std::vector<Vec3>& faceNormals, std::uint32_t count,
                                  int levels, std::uint64_t seed, const Progress& progress);

}  // namespace lambent::synthesis
