// An atmosphere at given wavelengths: the numbers that light meets.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lambent/media/density_profile.h"
#include "lambent/media/phase_function.h"
#include "lambent/media/shell.h"
#include "lambent/sky/atmosphere.h"

namespace lambent::sky {

/// What the air is a mixture of.
enum Part { kAir = 0, kAerosol = 1, kOzone = 2 };
inline constexpr int kParts = 3;

struct Medium {
  media::Shell shell;                                              ///< m
  std::vector<double> wavelengths;                                 ///< nm
  std::vector<media::DensityProfile> profiles;                     ///< of each Part
  media::PhaseFunction aerosolPhase;                               ///< air scatters by Rayleigh's
  std::array<std::vector<double>, kParts> scattering, extinction;  ///< 1/m at density 1
  std::vector<double> albedo;                                      ///< of the ground
  std::vector<double> solarIrradiance;                             ///< W m⁻² nm⁻¹ at 1 AU
};

Medium mediumOf(const Atmosphere& atmosphere, std::span<const double> wavelengths);

}  // namespace lambent::sky
