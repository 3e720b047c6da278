// Rotation of spherical functions: g(Q s) = f(s), by any rotation matrix.
#pragma once

#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::sh {

/// out = coefficients of the function turned by dstFromSrc (a proper rotation): what stood in
/// direction s stands in dstFromSrc·s. in and out may be the same span. Asserts on a matrix that is
/// not a rotation. The fast path for one vector.
void rotate(int bands, const Mat3& dstFromSrc, std::span<const float> in, std::span<float> out);
RgbCoefficients rotate(const Mat3& dstFromSrc, const RgbCoefficients& f);

/// The block-diagonal rotation as an explicit n²×n² matrix, row-major, double precision.
std::vector<double> rotationMatrix(int bands, const Mat3d& dstFromSrc);

}  // namespace lambent::sh
