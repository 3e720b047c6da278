// Low-discrepancy point sets: directions on the sphere, points in the unit square.
#pragma once

#include <cstdint>
#include <vector>

#include "lambent/math/types.h"

namespace lambent::math {

/// `count` unit vectors of nearly equal spacing, in the sequence of falling z: each stands for the
/// solid angle 4π/count (swinbank2006fibonacci, with the offset lattice: z = 1 − (2i+1)/count).
std::vector<Vec3> sphericalFibonacci(int count);

/// The index-th point of the two-dimensional Sobol sequence, shuffled and Owen-scrambled by `seed`,
/// in [0, 1)². Every aligned block of 2^k indices is stratified in all its elementary intervals,
/// and sequences of different seeds can be padded together for more dimensions
/// (burley2020practical).
Vec2 sobol2(std::uint32_t index, std::uint32_t seed);

/// The index-th point of the additive recurrence on the plastic number, shifted by `offset`
/// (roberts2018unreasonable): even for every number of points, not only for powers of two.
Vec2 r2(std::uint32_t index, const Vec2& offset = Vec2(0.5f, 0.5f));

/// The digits of `index` in `base` mirrored at the point: the one-dimensional Halton sequence.
double radicalInverse(std::uint32_t base, std::uint64_t index);

}  // namespace lambent::math
