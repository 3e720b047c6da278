// The skies of the International Commission on Illumination: overcast, clear (1973), and the
// fifteen of the standard general sky. Luminance alone, in cd m⁻², in the Sun's frame; below the
// horizon what stands at the horizon above.
#pragma once

#include "lambent/sky/sun_frame.h"

namespace lambent::sky {

/// The sky under thick cloud: L_z (1 + 2 cos θ) / 3.
struct OvercastSky {
  double zenithLuminance = 1;  ///< cd m⁻²
  double luminance(const Vec3d& direction) const;
};
/// With the zenith luminance 123 + 8600 sin h cd m⁻² (krochmann1974quantitative), h the Sun's
/// elevation.
OvercastSky cieOvercast(double sunElevation);

/// A sky made of a gradation towards the horizon and an indicatrix about the Sun.
struct GradedSky {
  Gradation gradation;
  Indicatrix indicatrix;
  Vec3d sun{0, 1, 0};          ///< unit vector
  double zenithLuminance = 1;  ///< cd m⁻²
  /// L_z f(γ) φ(θ) / (f(θ_s) φ(0)).
  double luminance(const Vec3d& direction) const;
};

/// CIE's clear sky of 1973. Turbidity is Linke's, for light: 2.45 is a clear rural sky. Zenith
/// luminance is (1.376 T − 1.81) tan h + .38 kcd m⁻² (karayel1984zenith); h above 75°, beyond what
/// that was measured at, counts on along the tangent's slope there, and T is kept in 1.4 … 12.
GradedSky cieClear(double sunElevation, double turbidity = 2.45);

/// One of the fifteen.
struct StandardSkyShape {
  Gradation gradation;
  Indicatrix indicatrix;
  /// Typical of the type: illuminance from the sky over that of the Sun above the air, both on a
  /// horizontal plane (darula2002cie).
  double diffuseRatio;
};
/// type 1 … 15; others are taken to the nearest.
const StandardSkyShape& standardSkyShape(int type);
/// Its luminance over that in the zenith.
double relativeLuminance(const StandardSkyShape& shape, double sunElevation,
                         const Vec3d& direction);
/// With the zenith luminance for which the sky gives the type's typical illuminance: diffuseRatio ·
/// 133.8 klx / m, where m is the optical air mass.
GradedSky standardSky(int type, double sunElevation);

}  // namespace lambent::sky
