// Optical lengths: the length that a path through air of changing density would have in air of the
// density at the ground.
#pragma once

#include <vector>

#include "lambent/media/density_profile.h"
#include "lambent/media/shell.h"

namespace lambent::media {

/// The places along a ray between which every profile is smooth: distances in m, rising, from 0 to
/// `end`. Where the ray crosses the profiles' breaks, and where it is closest to the ground.
std::vector<double> smoothPieces(const Shell& shell, double altitude, double cosine, double end,
                                 const std::vector<double>& breaks);

/// ∫ density ds from `altitude` for `distance`, m; good to 1e-8 of it. cosine: of the zenith angle.
double opticalLength(const Shell& shell, const DensityProfile& profile, double altitude,
                     double cosine, double distance);

/// From `altitude` to the top of the shell. A ray below the horizon goes on through the planet, with
/// the density at its ground.
double opticalLengthToTop(const Shell& shell, const DensityProfile& profile, double altitude,
                          double cosine);

/// chapman1931absorption: (1/H) ∫ exp(−h/H) ds to infinity, for X = (radius + altitude)/H and a zenith angle
/// in rad up to 90°.
double chapman(double x, double zenithAngle);

}  // namespace lambent::media
