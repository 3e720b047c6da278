// What lights that are symmetric about an axis share. Internal to the room.
#pragma once

#include <span>

#include "lambent/math/types.h"
#include "lambent/sh/zonal.h"

namespace lambent::light {

/// A unit axis, turned.
Vec3d turned(const Mat3& dstFromSrc, const Vec3d& axis);

/// Adds color · the zonal function about `axis` to `out`, as Component::addProjection has it.
void addZonal(const sh::ZonalMoments& moments, const Vec3d& axis, const Rgb& color,
              std::span<double> out);

/// A unit vector at an angle from `axis`, given by versine = 1 − cos: that keeps the digits of
/// small angles, which cos itself loses. `turn` in [0, 1) about the axis.
Vec3d aroundAxis(const Vec3d& axis, double versine, double turn);

}  // namespace lambent::light
