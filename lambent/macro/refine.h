// Receivers where they are needed: triangles cut until light interpolated between their corners is
// what is simulated inside of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"

namespace lambent::macro {

struct RefineOptions {
  /// How far interpolated light may be off, as InterpolationError counts it: radiance of a white
  /// surface under skies whose radiance has a root mean square of 1. > 0.
  double error = 0.01;
  std::size_t budget = 20000;  ///< vertices to add, at most
  int bands = 5;               ///< of the light, 1 … 10
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has. No effect on the result
};

struct Refined {
  scene::Scene scene;
  std::size_t added = 0;  ///< vertices
  bool spent = false;     ///< the budget ended it, and not the error
};

/// The scene with triangles cut at their longest edges, first where the mean squared error times the
/// area is largest, until the error is met, edges are as short as a 128th of what surfaces are apart
/// from each other (the median of what rays between them measure), or the budget is used. The error
/// is a root mean square over a triangle, or, for a small one, over a patch with sides of a quarter
/// of that distance, of which the triangle is the only part that errs. Surfaces, materials and what
/// is interpolated over them stay as they are (scene/split_edges.h). Meshes whose receivers are
/// texels or which have none are cut only where their edges are those of others. `rays` and
/// `receivers` are the scene's. BadUsage for options out of range; Cancelled.
Result<Refined> refine(const scene::Scene& scene, const trace::RayScene& rays,
                       const transport::PlacedReceivers& receivers, const RefineOptions& options,
                       const Progress& progress);

}  // namespace lambent::macro
