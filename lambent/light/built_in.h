// The components that this room makes. Internal to it.
#pragma once

#include "lambent/light/component.h"
#include "lambent/light/skylight.h"

namespace lambent::light {

ComponentPtr makeUniform(const Rgb& radiance);
/// Environment::Parts::Disc in double precision; `up` of no length: no horizon.
struct DiscShape {
  Vec3d axis;
  double versine;
  Rgb radiance;
  Rgb darkening = Rgb::Zero();
  Vec3d up = Vec3d::Zero();
  double horizon = -1;
};
ComponentPtr makeDisc(const DiscShape& shape);
ComponentPtr makeLimbDarkened(const Environment::LimbDarkened& disc);
/// Radiance where up·s ≤ sine of the horizon.
ComponentPtr makeGround(const Vec3d& up, double horizon, const Rgb& radiance);
ComponentPtr makeSkylight(std::shared_ptr<const Skylight> light, const Mat3& worldFromSky);
ComponentPtr makeDirectional(const Vec3d& direction, const Rgb& irradiance);
ComponentPtr makeClampedCosine(const Vec3d& axis, const Rgb& radiance);
ComponentPtr makeHarmonics(sh::RgbCoefficients coefficients);
/// Pixels that are not finite count as black.
ComponentPtr makeLatLong(image::Image image);

}  // namespace lambent::light
