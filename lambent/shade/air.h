// Air between the viewer and surfaces: aerial perspective in relit pictures.
#pragma once

#include <memory>
#include <optional>

#include "lambent/math/types.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/scene.h"

namespace lambent::sky {
class AirTable;
struct SamplingPlanes;
}  // namespace lambent::sky

namespace lambent::shade {

/// Shafts of light (see sky/shafts.h): as many planes across the view, from the camera to the end of the
/// scene, and samples of the Sun's visibility between two of them.
struct Shafts {
  int planes = 16;
  int samples = 4;
};

/// The viewer of the table is the camera, wherever it stands in the scene. Surfaces are seen through
/// the air; the sky is not: it is air already. What the background has
/// below the horizon is the ground of the planet, and shafts of light stand before all.
struct Air {
  std::shared_ptr<const sky::AirTable> table;  ///< never null
  /// Turns a direction of the asset's frame into the Sun's frame (see sky/dome.h).
  Mat3d sunFromAsset = Mat3d::Identity();
  double metresPerUnit = 1;  ///< of the asset's frame
  /// Under a sharp Sun: what does not see it shadows the air before it as well.
  std::optional<Shafts> shafts;

  /// L_s, W m⁻² sr⁻¹: what is seen of `radiance` that comes from `distance` (in units of the asset's
  /// frame) along the unit `direction` from the eye. A channel can be negative (see
  /// sky::AirBetween).
  Rgb seen(const Vec3& direction, float distance, const Rgb& radiance) const;

  /// The same of a background's `radiance`.
  Rgb seenBehind(const Vec3& direction, const Rgb& radiance) const;

  /// Of the shafts: across the view of `camera`, in the Sun's frame and in m, up to the end of `box`.
  sky::SamplingPlanes planes(const scene::Camera& camera, const scene::Box& box) const;
};

}  // namespace lambent::shade
