// What the shadows of things take from the air before what is seen, on the CPU.
#pragma once

#include <optional>

#include "lambent/light/sun.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/air.h"
#include "lambent/sky/shafts.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::reference {

class ShadowedAir {
 public:
  enum class By {
    Planes,  ///< sampling planes across the view, as shaders/shafts.glsl
    March,   ///< edges of shadows looked for along each ray
  };
  /// `air` has shafts, and it and `rays` outlive this. `box`: of what throws shadows.
  ShadowedAir(const shade::Air& air, const trace::RayScene& rays, const scene::Camera& camera,
              const scene::Box& box, By by);

  /// Radiance along a ray to what stands at `distance`; nothing: to the background.
  Rgb missing(const scene::Ray& ray, std::optional<float> distance, const Vec3& towardsSun) const;

 private:
  const shade::Air& air_;
  const trace::RayScene& rays_;
  sky::AerialPerspective form_;
  sky::SamplingPlanes planes_;
  By by_;
};

}  // namespace lambent::reference
