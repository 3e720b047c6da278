// The light of a distant sphere: images, discs, harmonics, uniform, and sums of them. It can be
// looked up, projected to harmonics, and importance-sampled.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::light {

class Component;
class Skylight;

/// Radiance from every direction (W m⁻² sr⁻¹ per channel), directions in world space pointing away
/// from the scene. A value: cheap to copy, immutable, thread-safe.
class Environment {
 public:
  Environment();  ///< black

  static Environment uniform(const Rgb& radiance);
  /// A disc of constant radiance around a unit direction; angular diameter in radians.
  static Environment disc(const Vec3& direction, double angularDiameter, const Rgb& radiance);
  /// A disc that is darker towards its limb, of which only what stands above a horizon is seen: the
  /// Sun.
  struct LimbDarkened {
    Vec3 direction;          ///< of its centre, unit
    double angularDiameter;  ///< rad, above 0 and up to 0.2
    Rgb irradiance;          ///< of what is seen of it, on a surface that faces `direction`
    /// u, 0 … 1: radiance = centre · (1 − u (1 − μ)), μ = √(1 − (1 − cos θ)/(1 − cos half)), with
    /// half of the angular diameter; that is √(1 − (θ/half)²) for a small disc.
    Rgb darkening = Rgb::Zero();
    Vec3 up = Vec3::UnitY();    ///< unit
    double horizon = -kPi / 2;  ///< elevation about `up`, rad
  };
  static Environment disc(const LimbDarkened& disc);
  /// A light at infinity in one direction: irradiance on a surface that faces it (W m⁻²). It has
  /// no radiance to look up; project() and sample() know it.
  static Environment directional(const Vec3& direction, const Rgb& irradiance);
  /// Radiance · max(0, cos) about a unit axis.
  static Environment clampedCosine(const Vec3& axis, const Rgb& radiance);
  /// A light given by its harmonics. Where it rings below zero its radiance is negative, and stays
  /// so.
  static Environment harmonics(sh::RgbCoefficients coefficients);
  /// A map in latitude and longitude: the pixel at (u, v), v from the top, is the direction with
  /// u = atan2(z, x)/2π + ½ and elevation asin(y) = π(½ − v); bilinear between the pixels' centres.
  /// Pixels that are not finite count as black; negative ones stay.
  static Environment latLong(image::Image image);
  /// The light above a horizon (skylight.h), turned from its own frame, a proper rotation.
  static Environment skylight(std::shared_ptr<const Skylight> light, const Mat3& worldFromSky);
  /// The same radiance from everywhere at the horizon and below it: what a sky leaves dark.
  /// `horizon` is its elevation about the unit vector `up`, rad.
  static Environment ground(const Vec3& up, double horizon, const Rgb& radiance);
  /// A disc, or a ground, as parts() tells it.
  struct Disc {
    Vec3 axis;                    ///< unit
    double versine;               ///< 1 − cos of half the angular diameter
    Rgb radiance;                 ///< of its centre
    Rgb darkening = Rgb::Zero();  ///< as LimbDarkened has it
    Vec3 up = Vec3::Zero();       ///< seen where up·s ≥ horizon
    double horizon = -1;          ///< a sine
  };
  static Environment disc(const Disc& disc);
  /// Any light that meets what component.h asks for: how other rooms make one.
  static Environment of(std::shared_ptr<const Component> component);

  /// What stood in direction s stands in dstFromSrc·s (a proper rotation).
  Environment rotated(const Mat3& dstFromSrc) const;
  friend Environment operator+(const Environment& a, const Environment& b);

  /// From a unit direction; without the directional lights.
  Rgb radiance(const Vec3& direction) const;
  /// ∫ radiance y_i ds for 1 … 10 bands, directional lights included: closed forms for the analytic
  /// lights, and for an image the exact projection of what radiance() returns.
  sh::RgbCoefficients project(int bands) const;

  /// A direction drawn in proportion to radiance (luminance of its absolute value), for two uniform
  /// numbers in [0, 1). The mean of radianceOverPdf · f(direction) is ∫ radiance f ds, directional
  /// lights included.
  struct Sample {
    Vec3 direction;
    Rgb radianceOverPdf;  ///< radiance / pdf: the estimator's weight
    float pdf = 0.0f;     ///< per steradian; infinite for a directional light
  };
  Sample sample(float u1, float u2) const;
  /// The density with which sample() draws a direction, sr⁻¹; never 0 where there is radiance. Over
  /// the sphere it integrates to 1 less the share of draws that goes to directional lights.
  float pdf(const Vec3& direction) const;

  /// What radiance() adds up, for those who look it up elsewhere, as shaders do.
  struct Parts;
  Parts parts() const;

  struct Impl;

 private:
  explicit Environment(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

struct Environment::Parts {
  using Disc = Environment::Disc;
  /// As latLong(); pixels that were not finite are black. Environments that are rotations of one
  /// another share the image.
  struct LatLong {
    std::shared_ptr<const image::Image> image;
    Mat3 worldFromImage;
  };
  /// As skylight(); rotations of one another share the light.
  struct Sky {
    std::shared_ptr<const Skylight> light;
    Mat3 worldFromSky;
    double horizon;  ///< its sine: seen where up·s is above it, up being worldFromSky's column 1
  };
  Rgb uniform = Rgb::Zero();
  std::vector<Disc> discs;
  std::vector<LatLong> images;
  std::optional<Sky> sky;           ///< the first, if there are several
  std::vector<Environment> others;  ///< of one component each
};

}  // namespace lambent::light
