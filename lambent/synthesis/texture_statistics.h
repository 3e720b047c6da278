// How far a result looks like its patch, and how far it repeats itself, from windows on the surface.
#pragma once

#include <span>

#include "lambent/synthesis/patch_look.h"
#include "lambent/synthesis/surface_windows.h"

namespace lambent::synthesis {

/// How unlike a surface looks from its patch laid flat, both seen from straight above: 0 where it
/// looks the same.
struct Unlikeness {
  /// Statistics at four scales, as texture models take them: of lightness its Laplacian and four
  /// oriented bands, and of colours, the Wasserstein distance between their histograms in standard
  /// deviations of the patch's; and of pairs of bands, how far correlations of magnitudes are apart.
  /// Their mean.
  double statistics = 0.0;
  /// How much of each neighbourhood, a quarter of a window across, is nowhere in the patch: the mean
  /// squared difference of colours from the best of those places of the patch that stand there, where
  /// 1 is that of places drawn at random.
  double misfit = 0.0;
};

/// Each window is compared with the patch continued from the window's middle over the same square.
/// `size` as the windows', metres. Windows of a period, or half of one, are right; there must be one
/// at least.
Unlikeness unlikenessOf(std::span<const SurfaceWindow> windows, float size, const Vec2& period,
                        const PatchLook& look);

/// The largest autocorrelation at a distance of a quarter of the period (the shorter one) or more,
/// up to half of a window, less what the patch has of its own within its period (0 where that is
/// more): 0 for what never comes again, or comes again as the patch does itself.
double repetitionOf(std::span<const SurfaceWindow> windows, float size, const Vec2& period,
                    const PatchLook& look);

}  // namespace lambent::synthesis
