// Air between the viewer and surfaces: aerial perspective in relit pictures.
#pragma once

#include <memory>

#include "lambent/math/types.h"

namespace lambent::sky {
class AirTable;
}

namespace lambent::shade {

/// The viewer of the table is the camera, wherever it stands in the scene. Surfaces are seen through
/// the air; the background is not: it is the sky, air already.
struct Air {
  std::shared_ptr<const sky::AirTable> table;  ///< never null
  /// Turns a direction of the asset's frame into the Sun's frame (see sky/dome.h).
  Mat3d sunFromAsset = Mat3d::Identity();
  double metresPerUnit = 1;  ///< of the asset's frame

  /// L_s, W m⁻² sr⁻¹: what is seen of `radiance` that comes from `distance` (in units of the asset's
  /// frame) along the unit `direction` from the eye. A channel can be negative (see
  /// sky::AirBetween).
  Rgb seen(const Vec3& direction, float distance, const Rgb& radiance) const;
};

}  // namespace lambent::shade
