// Aerial perspective: what air does to what is seen through it (preetham2003modeling):
//   L_s = f · L_0 + L_in
// for air, aerosols and ozone, in three forms with one interface: the exact integral, a table of it
// that a shader can look up, and the seed's closed form for air of constant density.
//
// Directions are unit vectors in the Sun's frame (see dome.h), from the viewer; distances are in m
// along them.
#pragma once

#include "lambent/math/types.h"
#include "lambent/media/phase_function.h"
#include "lambent/report/result.h"
#include "lambent/sky/air_colors.h"
#include "lambent/sky/atmosphere.h"
#include "lambent/sky/scattering.h"

namespace lambent::sky {

/// What air between a viewer and a place does to light from there. Linear RGB.
struct AirBetween {
  Eigen::Array3d extinction = Eigen::Array3d::Ones();  ///< f, 0 … 1
  /// Scattered towards the viewer once, straight from the Sun: what the shadows of things that are
  /// not in the air take away. W m⁻² sr⁻¹; negative in a channel for colours outside of Rec. 709.
  Eigen::Array3d fromSun = Eigen::Array3d::Zero();
  Eigen::Array3d multiple = Eigen::Array3d::Zero();  ///< scattered more than once

  Eigen::Array3d inScattered() const { return fromSun + multiple; }
  /// L_s
  Eigen::Array3d seen(const Eigen::Array3d& radiance) const {
    return extinction * radiance + inScattered();
  }
};

/// Who sees it, and when.
struct ViewerInAir {
  double altitude = 0;      ///< m, within the air
  double sunElevation = 0;  ///< rad, at the viewer
  double sunDistance = 1;   ///< AU
};
/// BadUsage where the viewer is below the ground or above the air, or a number is none.
Status checkViewer(const ViewerInAir& viewer, const media::Shell& shell);

/// The integral itself, by a march along each ray, of every wavelength that the Scattering has: as
/// many as one wants colours of.
class ExactAir {
 public:
  /// The atmosphere is the one that was solved; it knows the spectrum of the Sun.
  ExactAir(Scattering scattering, const Atmosphere& atmosphere, const ViewerInAir& viewer);
  /// Below the ground the air goes on as it is on it: there are valleys.
  AirBetween at(const Vec3d& direction, double distance) const;

 private:
  Scattering scattering_;
  ViewerInAir viewer_;
  Vec3d sun_;
  AirColors colors_;
};

/// The seed's form: the density is the viewer's everywhere, and so is the Sun's light; light scattered
/// more than once is left out.
///   f = e^(−β s),  L_in = E_s β(θ) / β · (1 − e^(−β s))
/// Of two kinds of particles β(θ) is the sum of both, and so is β. A channel has the β and E_s β(θ) that
/// make the colours of a short path exact. A value: copy it to a shader as it is.
struct ConstantAir {
  Eigen::Array3d extinction = Eigen::Array3d::Zero();  ///< β, 1/m
  /// E_s β(θ) without the phase functions, W m⁻² per m.
  Eigen::Array3d air = Eigen::Array3d::Zero(), aerosol = Eigen::Array3d::Zero();
  media::PhaseFunction aerosolPhase;
  Vec3d sun = Vec3d::UnitY();

  AirBetween at(const Vec3d& direction, double distance) const;
};
ConstantAir constantAir(const Scattering& scattering, const Atmosphere& atmosphere,
                        const ViewerInAir& viewer);

}  // namespace lambent::sky
