// One path: its estimate of the radiance that arrives or leaves.
#pragma once

#include <variant>

#include "lambent/light/environment.h"
#include "lambent/reference/emitters.h"
#include "lambent/reference/path_tracer.h"
#include "lambent/reference/sampler.h"
#include "lambent/reference/scattering.h"
#include "lambent/reference/shadowed_air.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/layers.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/trace/veils.h"

namespace lambent::reference {

class Integrator {
 public:
  /// Keeps references: everything must outlive it.
  Integrator(const scene::Scene& scene, const trace::RayScene& rays,
             const light::Environment& environment, const PathTraceOptions& options);

  /// Before seen(): shafts of light reach as far as the scene does from there.
  void lookFrom(const scene::Camera& camera);

  /// An unbiased estimate of the radiance that leaves `point` towards `toViewer`.
  Rgb leaving(const scene::SurfacePoint& point, const Vec3& toViewer, Sampler& sampler) const;

  struct Seen {
    Rgb radiance;
    float coverage;  ///< 1 where a surface is, or the background is shown
  };
  Seen seen(const scene::Ray& ray, Sampler& sampler) const;

 private:
  struct Escaped {
    Vec3 origin, direction;
    int mirrors;
  };
  struct Blocked {};
  struct Surface {
    scene::SurfacePoint point;
    Vec3 toViewer;  ///< back along the ray that arrived
    int mirrors;    ///< on the way
  };
  /// Where a ray ends when mirrors are followed, and what they left of the light in `tint`; and, if
  /// `haze` is asked for, as eyes see it: through air, which adds that, and with layers.
  using End = std::variant<Blocked, Escaped, Surface>;
  End follow(Vec3 origin, Vec3 direction, int mirrors, Rgb& tint, Sampler& sampler,
             Rgb* haze = nullptr) const;
  std::optional<trace::Hit> met(const Vec3& origin, const Vec3& direction, Rgb& tint,
                                Sampler& sampler) const;
  trace::Hit uppermost(trace::Hit hit, Sampler& sampler) const;
  void passAir(const scene::Ray& ray, std::optional<float> distance, int mirrors, Rgb& tint,
               Rgb& haze) const;
  Rgb radianceBehind(const Escaped& escaped) const;

  /// Without what the point itself emits.
  Rgb scattered(scene::SurfacePoint point, Vec3 toViewer, Sampler& sampler) const;
  Rgb drawnFromEmitters(const Vec3& origin, const Scattering& scattering, Sampler& sampler) const;
  Vec3 lifted(const scene::SurfacePoint& point) const;

  const scene::Scene& scene_;
  const trace::RayScene& rays_;
  const light::Environment& environment_;
  PathTraceOptions options_;
  Emitters emitters_;
  trace::Veils veils_;
  scene::Layers layers_;
  std::optional<ShadowedAir> shafts_;
  Vec3 towardsSun_ = Vec3::UnitY();  ///< of shafts_
  bool hasMirrors_ = false;
};

}  // namespace lambent::reference
