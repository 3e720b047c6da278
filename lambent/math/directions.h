// Frames about a normal, and the ways from the unit square to directions, each with its density.
// Warps return directions in the tangent frame, +z the axis; u is in [0, 1)².
#pragma once

#include <cmath>

#include "lambent/math/types.h"

namespace lambent::math {

/// A right-handed orthonormal frame whose third column is the unit vector `normal`; continuous but
/// for a cut at normal.z = 0 (duff2017building).
Mat3 worldFromTangent(const Vec3& normal);

/// Area-preserving map of the unit square onto the unit disc that keeps neighbours
/// (shirley1997low).
Vec2 concentricDisc(const Vec2& u);
/// Its inverse; a point outside of the unit disc is taken to its rim.
Vec2 squareFromDisc(const Vec2& disc);

/// The unit square over the hemisphere about +z, area for area: every cell of an n×n grid covers
/// 2π/n² sr (shirley1997low with z = 1 − r²). And back: a direction below the horizon is taken to
/// the horizon.
Vec3 hemisphereFromSquare(const Vec2& u);
Vec2 squareFromHemisphere(const Vec3& direction);

Vec3 uniformSphere(const Vec2& u);
Vec3 uniformHemisphere(const Vec2& u);
Vec3 cosineHemisphere(const Vec2& u);                 ///< density ∝ cos θ
Vec3 phongLobe(const Vec2& u, float exponent);        ///< density ∝ cosʳ θ on the hemisphere
Vec3 uniformCone(const Vec2& u, float cosHalfAngle);  ///< within the half-angle of +z

// Densities, sr⁻¹, at a direction whose cosine with the axis is cosTheta.
float uniformSpherePdf();
float uniformHemispherePdf(float cosTheta);
float cosineHemispherePdf(float cosTheta);
float phongLobePdf(float cosTheta, float exponent);
float uniformConePdf(float cosTheta, float cosHalfAngle);

/// The mirror image of the unit vector `outgoing` (pointing away from the surface) about the unit
/// normal: 2 (n·o) n − o, which points away from the surface as well.
Vec3 reflectAbout(const Vec3& outgoing, const Vec3& normal);

/// The direction at an azimuth from +x towards +z and an elevation from the horizon up to +y,
/// radians, as latitude-longitude images and the SOURCE of light have them.
inline Vec3d directionFromAzimuthElevation(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

template <class Scalar>
struct AzimuthElevation {
  Scalar azimuth;    ///< −π … π
  Scalar elevation;  ///< −π/2 … π/2
};

/// The inverse, of a direction of any length but 0. Of the tangent, which keeps its digits at the
/// poles where the sine has none left.
template <class Scalar>
AzimuthElevation<Scalar> azimuthElevationOf(const Eigen::Matrix<Scalar, 3, 1>& direction) {
  const Scalar x = direction.x(), y = direction.y(), z = direction.z();
  return {std::atan2(z, x), std::atan2(y, std::sqrt(x * x + z * z))};
}

}  // namespace lambent::math
