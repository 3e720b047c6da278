// How the light of the Sun's disc falls into the pixels of a picture.
#pragma once

#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sky/dome.h"

namespace lambent::sky {

/// The exponent α of the Sun's limb darkening, radiance ∝ μ^α with μ = √(1 − ρ²), at a wavelength in
/// nm (hestroffer1998wavelength; between their ranges, 372 … 416 nm, the straight
/// line): .51 at 550 nm.
double limbDarkening(double nanometres);

/// The disc as it stands over the horizon, in as many kinds of light as there are exponents of limb
/// darkening. Shares of pixels that tile the sky sum to 1 whatever their size: a pixel's share is an
/// integral along its border, which its neighbours have too.
class SunCoverage {
 public:
  /// `horizon`: its elevation, rad; what is below it is cut off.
  SunCoverage(const SunDisc& sun, double horizon, std::vector<double> exponents);

  /// Whether any of the disc is above the horizon.
  bool isVisible() const { return visible_; }
  /// Unit, in the Sun's frame.
  const Vec3d& centre() const { return centre_; }
  double angularRadius() const { return angularRadius_; }

  /// The share of the visible disc's light that comes from within a closed outline of directions in
  /// the Sun's frame, for each exponent, into as many. The outline is a polygon in a projection that
  /// keeps areas, within a right angle of the Sun.
  void shares(std::span<const Vec3d> outline, std::span<double> shares) const;
  /// The same in a direction, per sr: 0 outside of what is visible of the disc.
  void densities(const Vec3d& direction, std::span<double> densities) const;

 private:
  using Point = Vec2d;

  Point inPlane(const Vec3d& direction) const;
  /// Of the part of a polygon above the horizon, Σ ∮ F dφ.
  void integrate(const std::vector<Point>& polygon, std::span<double> sums) const;

  double angularRadius_;
  Vec3d centre_, right_, up_;
  double horizon_;  ///< in the plane: above the centre, in radii of the disc
  std::vector<double> exponents_, whole_;
  bool visible_ = false;
};

}  // namespace lambent::sky
