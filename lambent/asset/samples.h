// The sample assets of spec/samples: built from closed forms, for tests and for the tool that
// writes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lambent/asset/asset.h"

namespace lambent::asset {

/// A square of grey ρ = 0.5 that faces +y with nothing around it, 3 bands, 32-bit floats. All four
/// receivers hold M_i = ρ/π · Â_l · y_i(+y) (ramamoorthi2001efficient eq. 8).
Asset unoccludedSquare();

/// One mesh of every kind: vertex vectors (float16, 3 channels, base colour outside), texel vectors
/// (float16, 1 channel, one texel dilated), glossy matrices (float32, 1 channel, 2×3 bands) beside
/// vectors, and a mirror.
Asset everyLayout();

/// Two squares that carry a patch of stripes, 4×2 positions and 2×2 views, 3 bands, snorm8: one by
/// an id map of 2×2 texels with shadowed matrices (float16), which are the rotation into the
/// tangent frame; one by its own UVs, without matrices.
Asset biScale();

/// The same with heights: bands of the patch that are as deep as half its period, low and high.
Asset relief();

/// The same patch twice over one square: by an id map and, in a layer of one triangle whose vertices'
/// alphas are u, by its UVs.
Asset layered();

/// Interreflected transfer with the shadowed one beside: a square with vectors at its vertices
/// (float16; three channels, shadowed one) and a glossy one with vectors and matrices of 3 × 3
/// bands on 2×2 texels (float32). A veil lets through half of the light that an open square would
/// get; what it reflects adds a half, a quarter and an eighth of that for red, green and blue.
Asset keptShadowed();

/// Vectors on 2×2 texels of TEXCOORD_1 (float32), on a square whose TEXCOORD_0 repeats over it. The
/// second set mirrors u, so that a reader which takes the first one shows another picture: the
/// texels' reflectances are ½, ¼, ⅛ and 1/16.
Asset secondUvs();

/// File name → asset.
std::vector<std::pair<std::string, Asset>> samples();

}  // namespace lambent::asset
