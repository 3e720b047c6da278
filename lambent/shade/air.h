// Air between the viewer and surfaces: aerial perspective in relit pictures.
#pragma once

#include <memory>
#include <optional>

#include "lambent/math/types.h"
#include "lambent/scene/camera.h"
#include "lambent/scene/scene.h"

namespace lambent::sky {
struct AirBetween;
class AirTable;
class ExactAir;
struct SamplingPlanes;
}  // namespace lambent::sky

namespace lambent::shade {

/// Metres in one unit of a scene, where a person says how many: from the scale of cells to that of
/// planets.
inline constexpr double kLeastMetresPerUnit = 1e-6, kMostMetresPerUnit = 1e6;

/// Shafts of light (see sky/shafts.h): as many planes across the view, from the camera to the end of the
/// scene, and samples of the Sun's visibility between two of them.
struct Shafts {
  int planes = 16;
  int samples = 4;
};

/// How high an eye stands that nothing lifts, m.
inline constexpr double kLeastEyeHeight = 1.6;

/// The viewer of the table is the camera, wherever it stands in the scene: the sky that lights and
/// backs the scene is the one of the same altitude, and both must have one horizon. Surfaces are seen
/// through the air; the sky is not: it is air already. What the environment has below the horizon is
/// the ground of the planet, behind the scene and in mirrors alike; its distance goes by the altitude
/// of the table or the height of the eye in the scene, whichever is more. Shafts of light stand
/// before all.
struct Air {
  std::shared_ptr<const sky::AirTable> table;  ///< never null
  /// The integral that the table is of, for the CPU to take in its place; null: it takes the table.
  std::shared_ptr<const sky::ExactAir> exact = {};
  /// Turns a direction of the asset's frame into the Sun's frame (see sky/dome.h).
  Mat3d sunFromAsset = Mat3d::Identity();
  double metresPerUnit = 1;    ///< of the asset's frame
  Vec3 ground = Vec3::Zero();  ///< the world's origin, in that frame: heights are counted from it
  /// Under a sharp Sun: what does not see it shadows the air before it as well.
  std::optional<Shafts> shafts;

  /// Along the unit `direction` from the eye, for `distance` in units of the asset's frame.
  sky::AirBetween between(const Vec3& direction, float distance) const;
  /// L_s, W m⁻² sr⁻¹: what is seen of `radiance` that comes from `distance` (in units of the asset's
  /// frame) along the unit `direction` from the eye. A channel can be negative (see
  /// sky::AirBetween).
  Rgb seen(const Vec3& direction, float distance, const Rgb& radiance) const;

  /// The same of an environment's `radiance`, along a ray from an eye or a mirror at `from`.
  Rgb seenBehind(const Vec3& from, const Vec3& direction, const Rgb& radiance) const;

  /// Of the shafts: across the view of `camera`, in the Sun's frame and in m, up to the end of `box`.
  sky::SamplingPlanes planes(const scene::Camera& camera, const scene::Box& box) const;
};

}  // namespace lambent::shade
