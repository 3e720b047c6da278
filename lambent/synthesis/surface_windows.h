// Small squares of a surface that wears a patch, laid flat: what it looks like there, as a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/synthesis/worn_surface.h"

namespace lambent::synthesis {

struct WindowOptions {
  int pixels = 64;        ///< a side
  float size = 0.1f;      ///< metres of the surface that a side covers
  float filled = 0.98f;   ///< share of pixels that must lie on the surface
  float steepest = 0.5f;  ///< cosine to the middle's normal below which the surface counts as gone
};

/// A square about a texel in its tangent plane, +x along the patch's there. Distances from the middle
/// are those in space, directions those of the projection.
struct SurfaceWindow {
  std::uint32_t middle = 0;        ///< the texel
  int pixels = 0;                  ///< a side
  std::vector<Vec2> places;        ///< q at the middles of pixels, row 0 at −y
  std::vector<std::uint8_t> held;  ///< whether a pixel lies on the surface
};

/// Windows about texels drawn at random by area, the same ones for the same seed: `count` of them
/// or, where most of the surface has no room for them, as many as 8 · count attempts yield.
std::vector<SurfaceWindow> windowsOn(const WornTexels& texels, const Vec2& period, int count,
                                     const WindowOptions& options, std::uint64_t seed = 0);

}  // namespace lambent::synthesis
