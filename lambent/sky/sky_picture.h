// A sky as a picture.
#pragma once

#include <vector>

#include "lambent/image/channels.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/picture_shape.h"
#include "lambent/sky/sight.h"

namespace lambent::sky {

enum class Quantity {
  Radiance,   ///< R, G, B: see radianceRgb(); 683.002 (.2126 R + .7152 G + .0722 B) is cd/m²
  Luminance,  ///< Y, cd/m²
  Xyzv,       ///< X, Y, Z in cd/m², V scotopic, in scotopic cd/m²
  /// A channel for each wavelength, W m⁻² sr⁻¹ nm⁻¹, named as fichet2021openexr does
  /// ("S0.550,000000nm"), with R, G, B for those who look at it.
  Spectral,
};

struct SkyPictureOptions {
  PictureShape shape;
  Mat3d worldFromSun = Mat3d::Identity();  ///< turns the Sun's frame of the dome
  Quantity quantity = Quantity::Radiance;
  std::vector<double> wavelengths;  ///< of Spectral, nm, 340 … 740, rising
  BelowHorizon below = BelowHorizon::Dome;
  /// Whether the Sun's disc is in it, darker towards its limb. Each pixel has the mean over what it
  /// covers: summed over solid angle the disc is SunDisc::irradiance at any resolution.
  bool sun = false;
};

/// Channels as the quantity says; where the map leaves pixels empty they are 0, and a channel A says
/// which are (1: looks somewhere). Values are the sky's at a pixel's centre, means where the horizon
/// runs through it; none is negative. Attributes name the unit. BadUsage: a size (see checkShape), or
/// more than 2²⁸ values; Cancelled.
Result<image::ChannelImage> drawSky(const Sky& sky, const SkyPictureOptions& options,
                                    const Progress& progress = {});

/// "S0.550,000000nm"
std::string spectralChannel(double nanometres);

}  // namespace lambent::sky
