// A relit picture of an asset: what all makers of such pictures are told.
#pragma once

#include <optional>

#include "lambent/shade/air.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/showing.h"

namespace lambent::shade {

/// Linear radiance, never negative (what a ringing light drives below zero is cut off per pixel,
/// after averaging), with coverage in alpha: what covers half a pixel has half its radiance there.
/// With a background there is no alpha. Surfaces seen from behind are black. Only the front of a
/// material is lit. A mirror shows the asset's other surfaces as they are lit, and the environment
/// between them: on the CPU by rays, by OpenGL from a capture around it (local_capture.glsl).
struct PictureOptions {
  int width = 1024, height = 1024;
  int samples = 16;         ///< per pixel, at scene::subpixelPositions
  bool background = false;  ///< the environment behind the object; otherwise black, alpha 0
  Showing showing;          ///< what the asset does not hold is BadUsage
  /// A Sun in the light, in the asset's frame, whose shadows on diffuse surfaces are to be sharp.
  std::optional<SharpSun> sun;
  /// Between a perspective camera and what it sees.
  std::optional<Air> air;
};

}  // namespace lambent::shade
