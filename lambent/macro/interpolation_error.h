// How well the receivers of a mesh hold the shadows that fall between them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transport/receivers.h"

namespace lambent::macro {

struct InterpolationErrorOptions {
  int bands = 5;  ///< of the light, 1 … 10
  /// Radiance of a white surface under skies whose radiance has a root mean square of 1: what is
  /// further off counts as off.
  double tolerance = 0.03;
  /// Places that are looked at, at most: each costs the rays of 512 directions, and so do the
  /// corners of its triangle.
  std::size_t samples = 2048;
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has
  /// Whether how normals turn between receivers counts as well as shadows: not between vertices,
  /// which are what says how a surface is curved.
  bool withNormals = false;
};

/// The difference between shadows (direct light that is blocked) interpolated over triangles and
/// simulated inside of them, as radiance of a white surface under skies whose radiance has a root
/// mean square of 1 (sight.h has the formula). Half of the places lie evenly over all surfaces, the
/// others where something stands before a surface. Places inside of bodies do not count.
struct InterpolationError {
  std::size_t samples = 0;      ///< places that count
  double rms = 0.0;             ///< root mean square over them; the directions' noise is taken out
  double beyond = 0.0;          ///< share of them that are further off than the tolerance, 0 … 1
  std::uint32_t worstMesh = 0;  ///< that has most of the squared error
  double worstMeshShare = 0.0;  ///< how much of it, 0 … 1
};

/// One of those places.
struct PlaceError {
  std::uint32_t mesh = 0, triangle = 0;
  std::optional<double>
      squared;  ///< an estimate without bias, were it below 0; none inside of bodies
};
/// On the meshes that are looked at ([mesh]), which have receivers, whatever these stand on. The
/// same at any number of threads. Cancelled.
Result<std::vector<PlaceError>> placeErrors(const scene::Scene& scene, const trace::RayScene& rays,
                                            const transport::PlacedReceivers& receivers,
                                            const std::vector<bool>& isLookedAt,
                                            const InterpolationErrorOptions& options,
                                            const Progress& progress);

/// Of meshes whose receivers are vertices; `receivers` are the scene's. No value where there are
/// none. The same at any number of threads. Cancelled.
Result<std::optional<InterpolationError>> interpolationError(
    const scene::Scene& scene, const trace::RayScene& rays,
    const transport::PlacedReceivers& receivers, const InterpolationErrorOptions& options,
    const Progress& progress);

/// How a finding calls a mesh: mesh "floor", or mesh 3 where it has no name.
std::string meshInWords(const scene::Scene& scene, std::uint32_t mesh);

/// "coarse-receivers", where the error is larger than the tolerance; ends with the `remedy`.
Findings findingsOf(const InterpolationError& error, const scene::Scene& scene,
                    const InterpolationErrorOptions& options, std::string_view remedy);

}  // namespace lambent::macro
