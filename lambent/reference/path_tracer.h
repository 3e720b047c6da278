// The truth: a path tracer over the same Scene and light, with its own error bars.
#pragma once

#include <span>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::reference {

struct PathTraceOptions {
  int samples = 64;  ///< paths per pixel or per point
  int bounces =
      2;  ///< beyond the direct light, as in a bake; 0: direct light only. Mirrors do not count
  bool shadows = true;  ///< false: unshadowed direct light, no bounces
  std::uint64_t seed = 0;
  bool background = false;
  int threads = 0;  ///< 0: all
};

struct Picture {
  image::Image mean;      ///< linear radiance
  image::Image variance;  ///< of the mean, per pixel and channel
};

Result<Picture> picture(const scene::Scene& scene, const trace::RayScene& rays,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height, const PathTraceOptions& options,
                        const Progress& progress = {});

struct Estimate {
  Rgb mean, variance;  ///< variance of the mean
};

/// A surface point and the direction to who looks at it.
struct Probe {
  scene::SurfacePoint point;
  Vec3 toViewer;
};

/// Exit radiance at points, as a bake's receivers have it.
Result<std::vector<Estimate>> exitRadiance(const scene::Scene& scene, const trace::RayScene& rays,
                                           const light::Environment& environment,
                                           std::span<const Probe> probes,
                                           const PathTraceOptions& options,
                                           const Progress& progress = {});

}  // namespace lambent::reference
