// The components that this room makes. Internal to it.
#pragma once

#include "lambent/light/component.h"

namespace lambent::light {

ComponentPtr makeUniform(const Rgb& radiance);
ComponentPtr makeDisc(const Vec3d& axis, double angularDiameter, const Rgb& radiance);
ComponentPtr makeDirectional(const Vec3d& direction, const Rgb& irradiance);
ComponentPtr makeClampedCosine(const Vec3d& axis, const Rgb& radiance);
ComponentPtr makeHarmonics(sh::RgbCoefficients coefficients);
/// Pixels that are not finite count as black.
ComponentPtr makeLatLong(image::Image image);

}  // namespace lambent::light
