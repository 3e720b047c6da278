// The sky by day: every model beside the simulation, the simulation beside the published table,
// and the figures of preetham2003modeling.
#pragma once

#include "figures/studio.h"
#include "lambent/sky/make_sky.h"

namespace lambent::figures {

void skyMeridian(const Studio& studio);
void skyAccuracy(const Studio& studio);
void skyOpticalLengths(const Studio& studio);
void skyChromaticity(const Studio& studio);
void skyCompact(const Studio& studio);
void skyPreetham(const Studio& studio);
void skyAerial(const Studio& studio);
void sky24Hours(const Studio& studio);

inline constexpr double kDegree = kPi / 180;

/// The preset, with its tables kept where the tool keeps them.
sky::SkyOptions skyOptions(const std::string& preset, sky::Model model, double sunZenithDegrees);
/// Exits with what is wrong. Tables of the last atmosphere are kept, and so is every exact sky,
/// which takes minutes.
sky::Sky skyOf(const sky::SkyOptions& options);

/// In the Sun's frame: angle from the zenith, towards the Sun's azimuth plus `azimuth`; degrees.
inline Vec3d skyDirection(double viewZenith, double azimuth) {
  return Vec3d(std::sin(viewZenith * kDegree) * std::cos(azimuth * kDegree),
               std::cos(viewZenith * kDegree),
               std::sin(viewZenith * kDegree) * std::sin(azimuth * kDegree));
}

}  // namespace lambent::figures
