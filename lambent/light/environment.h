// The light of a distant sphere: images, discs, harmonics, uniform, and sums of them. It can be
// looked up, projected to harmonics, and importance-sampled.
#pragma once

#include <memory>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

/// Radiance from every direction (W m⁻² sr⁻¹ per channel), directions in world space pointing away
/// from the scene. A value: cheap to copy, immutable, thread-safe.
class Environment {
 public:
  Environment();  ///< black

  static Environment uniform(const Rgb& radiance);
  /// A disc of constant radiance around a unit direction; angular diameter in radians.
  static Environment disc(const Vec3& direction, double angularDiameter, const Rgb& radiance);
  /// A light at infinity in one direction: irradiance on a surface that faces it (W m⁻²). It has
  /// no radiance to look up; project() and sample() know it.
  static Environment directional(const Vec3& direction, const Rgb& irradiance);
  /// Radiance · max(0, cos) about an axis.
  static Environment clampedCosine(const Vec3& axis, const Rgb& radiance);
  static Environment harmonics(sh::RgbCoefficients coefficients);
  static Environment latLong(image::Image image);

  Environment rotated(const Mat3& dstFromSrc) const;
  friend Environment operator+(const Environment& a, const Environment& b);

  Rgb radiance(const Vec3& direction) const;
  sh::RgbCoefficients project(int bands) const;

  /// A direction drawn in proportion to radiance (luminance), for two uniform numbers in [0, 1).
  struct Sample {
    Vec3 direction;
    Rgb radianceOverPdf;  ///< radiance / pdf: the estimator's weight
    float pdf = 0.0f;     ///< per steradian; infinite for a directional light
  };
  Sample sample(float u1, float u2) const;
  float pdf(const Vec3& direction) const;

  struct Impl;

 private:
  explicit Environment(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

}  // namespace lambent::light
