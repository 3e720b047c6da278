// Patch → radiance transfer texture (sloan2003biscale §4.2).
#pragma once

#include <cstdint>

#include "lambent/meso/patch.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/transfer/field.h"

namespace lambent::meso {

/// How the light integral B_i = ∫ b(u, v, s) y_i(s) ds is taken.
enum class RttMethod {
  /// In the basis itself: at every point that is seen, directions over its whole hemisphere gather
  /// direct light with its harmonics and bounced light with what they meet (final gathering).
  Gather,
  /// As in the paper: an image for each of a grid of directional lights, summed by eq. (5).
  Images,
};

struct RttOptions {
  int width = 64, height = 64;  ///< positions, 1 … 1024 each
  int views = 8;        ///< a side, 1 … 32; 1: seen from +z alone, the diffuse special case
  int bands = 5;        ///< of the light, 1 … 10
  int bounces = 3;      ///< of light inside the patch beyond the direct, 0 … 64
  int supersample = 2;  ///< a side, 1 … 8: each position is the mean of so many squared
  RttMethod method = RttMethod::Gather;
  /// Over the whole sphere, from every point that is seen, 16 … 16384. Each sub-sample has its own
  /// lattice of them: with 2×2, a value is a sum over four times as many.
  int directions = 512;
  int lobeDirections = 64;                  ///< of a glossy point besides, 1 … 4096
  int polarLights = 8, azimuthLights = 16;  ///< Images: the grid of lights, 1 … 256 each
  std::uint64_t seed = 0;  ///< turns the lattices; two seeds give independent errors
  int threads = 0;         ///< 0: as many as the machine has. No effect on the result
  std::size_t blockTriangles = std::size_t(1) << 19;  ///< see PeriodicScene
};

/// What building an RTT cost.
struct RttCost {
  std::uint64_t viewRays = 0;   ///< from the eye
  std::uint64_t lightRays = 0;  ///< towards light, direct and bounced
  std::size_t facets = 0;       ///< places that hold bounced light
  int tilesAcross = 0;          ///< of the block that rays are traced in
};

/// B(u, v) of a patch. For every view v and sub-sample of a position u, the point that is seen is
/// where the ray along −v through u on the plane midway in the patch's depth, from above all of it,
/// first meets the surface; what is seen from behind or through a gap is black. Its height is kept
/// where there is more than one view, as the mean over sub-samples.
///
/// Errors: BadUsage for options out of range, BadInput as check(patch) and PeriodicScene::build
/// say, Cancelled. `cost` may be null.
Result<WithFindings<transfer::SimulatedRtt>> buildRtt(const Patch& patch, const RttOptions& options,
                                                      const Progress& progress,
                                                      RttCost* cost = nullptr);

/// The direction of a view: where the middle of its cell goes on the hemisphere.
Vec3 viewDirection(int views, int viewX, int viewY);

}  // namespace lambent::meso
