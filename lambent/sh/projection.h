// Projection of functions given as code.  Images are projected in lambent/image.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::sh {

/// f_i = ∫ f(s) y_i(s) ds by a product quadrature on the sphere (Gauss-Legendre in z, uniform in
/// azimuth) that is exact for functions of up to 2·resolution − bands bands.
std::vector<double> project(int bands, const std::function<double(const Vec3d&)>& f,
                            int resolution = 64);

}  // namespace lambent::sh
