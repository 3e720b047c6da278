// The truth: a path tracer over the same Scene and light, with its own error bars.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/air.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::reference {

struct PathTraceOptions {
  int samples = 64;  ///< paths per pixel or point; from 32 on rounded up to a multiple of 16, and
                     ///< best used if 16 · 2^k
  int bounces =
      2;  ///< beyond the direct light, as in a bake; 0: direct light only. Mirrors do not count
  bool shadows = true;  ///< false: unshadowed direct light, no bounces; lobes see the whole sphere
  std::uint64_t seed = 0;   ///< two seeds give independent errors
  bool background = false;  ///< picture: the environment where nothing is in front of it
  /// picture: before what its perspective camera sees, and what mirrors show it; light on its way to
  /// surfaces passes through none. Shafts of light by rays from each place that a ray passes towards
  /// the middle of the environment's Sun (light::sunOf), if it has one.
  std::optional<shade::Air> air = {};
  int threads = 0;  ///< 0: all. No effect on the result's bytes
};

struct Picture {
  image::Image mean;      ///< linear radiance, and coverage as alpha (none with a background);
                          ///< uncovered parts count as black: alpha is already multiplied in
  image::Image variance;  ///< of the mean, per pixel and channel
};

/// Unbiased, but for what no path can find: a directional light by way of a mirror. Fronts alone
/// scatter light, backs block it (and are black to a camera); a surface with a mirror reflectance
/// is a mirror and nothing else. The fronts of emitting materials (Material::emission) are seen and
/// light other surfaces; not so without shadows, where no surface counts but the one that is lit.
/// Pixels are box-filtered.
///
/// The variance is measured between 16 independent batches of paths (between paths, below 32
/// samples), so it is itself known within 37% (standard error) and (mean − truth)/√variance is
/// distributed as Student's t with 15 degrees of freedom. A single sample has infinite variance.
/// BadUsage for fewer samples than 1, negative bounces, a size outside 1 … 32768, or air before an
/// orthographic camera.
Result<Picture> picture(const scene::Scene& scene, const trace::RayScene& rays,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height, const PathTraceOptions& options,
                        const Progress& progress = {});

struct Estimate {
  Rgb mean, variance;  ///< variance of the mean
};

/// A surface point and the unit direction to who looks at it.
struct Probe {
  scene::SurfacePoint point;
  Vec3 toViewer;
};

/// Exit radiance at points, as a bake's receivers have it; statistics as picture()'s. The points
/// need not lie on the scene's surfaces.
Result<std::vector<Estimate>> exitRadiance(const scene::Scene& scene, const trace::RayScene& rays,
                                           const light::Environment& environment,
                                           std::span<const Probe> probes,
                                           const PathTraceOptions& options,
                                           const Progress& progress = {});

}  // namespace lambent::reference
