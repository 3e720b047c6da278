// Evaluation of the real spherical harmonics.
#pragma once

#include <span>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::sh {

/// All n² basis functions at a unit direction, in double precision, by recurrence; bands 1 … 32.
/// out.size() ≥ bands².
void evaluate(int bands, const Vec3d& direction, std::span<double> out);

/// All n² basis functions at a unit direction, in single precision, by code made at compile time
/// for each of bands 1 … 10. out.size() ≥ bands². This is the fast one: a few nanoseconds for 5
/// bands.
void evaluate(int bands, const Vec3& direction, std::span<float> out);

/// Σ_i f_i y_i(direction).
double reconstruct(std::span<const float> coefficients, const Vec3& direction);
Rgb reconstruct(const RgbCoefficients& coefficients, const Vec3& direction);

}  // namespace lambent::sh
