// Angles of the sky as analytic models have them, in the Sun's frame: +y up, the Sun in the half
// plane x ≥ 0, z = 0.
#pragma once

#include "lambent/math/types.h"

namespace lambent::sky {

/// Where an analytic model holds the Sun that it is given: its elevation in [0, π/2]. These models
/// know nothing of a Sun below the horizon; see twilight.h.
double modelledElevation(double sunElevation);

/// The Sun's direction.
Vec3d sunDirection(double sunElevation);

/// Angles of a direction, rad. Below the horizon it counts as the point of the horizon above it.
struct SkyAngles {
  double cosZenith = 1;  ///< cos θ, 0 … 1
  double zenith = 0;     ///< θ, 0 … π/2
  double cosSun = 1;     ///< cos γ
  double sun = 0;        ///< γ, from the Sun, 0 … π
};
SkyAngles skyAngles(const Vec3d& direction, const Vec3d& sun);

/// The form that CIE's general skies, perez1993all and preetham1999practical share: (1 + a e^(b /
/// cos θ)) (k + c e^(d γ) + e cos² γ). cos θ is kept above .01, where e^(b / cos θ) with the b of
/// skies, below −.1, is smaller than 10⁻⁴; a factor that would be negative is 0.
struct Gradation {
  double a = 0, b = -1;
  double at(double cosZenith) const;
};
struct Indicatrix {
  double c = 0, d = -1, e = 0, k = 1;
  double at(const SkyAngles& angles) const;
};

}  // namespace lambent::sky
