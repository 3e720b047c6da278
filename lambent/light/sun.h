// The part of a light that is too small for harmonics: a disc, as the Sun's, whose shadows are sharp.
#pragma once

#include <optional>
#include <vector>

#include "lambent/light/environment.h"
#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

/// Discs up to this angular diameter, rad, can be a light's Sun: 5°, far below what few bands tell
/// apart.
inline constexpr double kLargestSun = 5 * kPi / 180;

/// A disc of at most kLargestSun, of which something stands above its horizon.
struct Sun {
  Environment::Disc disc;
  Rgb irradiance;  ///< ∫ radiance ds over what is seen of it, W m⁻²
};

/// The disc of at most kLargestSun that brings most light (luminance of its irradiance), if there is
/// one. Other small discs are left to harmonics.
std::optional<Sun> sunOf(const Environment& environment);
/// What stood in direction s stands in dstFromSrc·s (a proper rotation).
Sun turned(const Mat3& dstFromSrc, const Sun& sun);
/// ∫ radiance y_i ds, 1 … 10 bands: the Sun's share of Environment::project.
sh::RgbCoefficients project(const Sun& sun, int bands);

/// One direction of a Sun, and the irradiance that it stands for on a surface that faces it.
struct SunPoint {
  Vec3 direction;  ///< unit
  Rgb irradiance;
};
/// `count` ≥ 1 points spread evenly over what is seen of the disc, and a part of them too. The mean of
/// irradiance is the Sun's in every channel, and that of irradiance · max(0, n·direction) is what falls
/// on a surface. A single point stands in the middle.
std::vector<SunPoint> pointsOf(const Sun& sun, int count);

}  // namespace lambent::light
