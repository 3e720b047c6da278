// A sky as numbers: what stands in a direction, and how bright it is there.
#pragma once

#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/sight.h"

namespace lambent::sky {

struct ReadingOptions {
  std::vector<double> wavelengths;  ///< nm, 340 … 740; none: luminance alone
  BelowHorizon below = BelowHorizon::Dome;
  bool sun = false;  ///< whether the Sun's disc is seen in directions that meet it
};

/// What stands in a direction.
struct Reading {
  std::vector<double> radiance;  ///< W m⁻² sr⁻¹ nm⁻¹, at each of the wavelengths
  double luminance = 0;          ///< cd/m²
};
/// In each direction (unit, in the Sun's frame).
std::vector<Reading> readSky(const Sky& sky, std::span<const Vec3d> directions,
                             const ReadingOptions& options);

/// How much light arrives: in W m⁻² over the wavelengths of the sky, or in lx.
struct Arriving {
  double directNormal = 0;  ///< of the Sun, on a surface that faces it
  double direct = 0;        ///< of the Sun, on a horizontal surface
  double diffuse = 0;       ///< of the sky, on a horizontal surface
  double global() const { return direct + diffuse; }
};
struct Brightness {
  Arriving irradiance, illuminance;
  double zenithLuminance = 0;  ///< cd/m²
};
Brightness brightnessOf(const Sky& sky);

}  // namespace lambent::sky
