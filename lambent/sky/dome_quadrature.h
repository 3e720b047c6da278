// Sums over the hemisphere above the horizon.
#pragma once

#include <functional>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::sky {

/// Directions of the half z ≥ 0 of the dome in the Sun's frame, each with the solid angle that it
/// and its mirror image stand for: skies are symmetric in z. The solid angles sum to 2π.
struct DomeQuadrature {
  std::vector<Vec3d> directions;
  std::vector<double> solidAngles;
};

/// Gauss-Legendre in the sine of the elevation and in azimuth from the Sun: with 32 × 32 directions
/// the illuminance of an analytic sky is right to 10⁻³, and to 10⁻⁴ with 64 × 64 (what limits it is
/// the cusp of these skies at the Sun).
DomeQuadrature domeQuadrature(int elevations = 32, int azimuths = 32);

/// ∫ f(s) s_y ds over the upper hemisphere: illuminance on a horizontal plane from luminance.
double onHorizontalPlane(const std::function<double(const Vec3d&)>& luminance,
                         const DomeQuadrature& quadrature);
/// With domeQuadrature(), made once.
double onHorizontalPlane(const std::function<double(const Vec3d&)>& luminance);

}  // namespace lambent::sky
