// Where on the patch a place of the surface lies: q(u) of sloan2003biscale §3.
#pragma once

#include <array>
#include <cstdint>

#include "lambent/scene/scene.h"
#include "lambent/scene/uv_steps.h"
#include "lambent/transfer/bi_scale.h"

namespace lambent::shade {

/// q, periods of the patch along x and y, each in [0, 1). uv as glTF has it, clamped to the id
/// map's border.
Vec2 patchPlace(const transfer::Patch& patch, const Vec2& uv);

/// The places of the patch that meet at a place of the surface, and their shares of it, which sum to 1.
struct PatchPlaces {
  int count = 0;
  std::array<Vec2, 4> q;  ///< not wrapped
  std::array<float, 4> share{};

  void add(const Vec2& place, float weight) {
    q[std::size_t(count)] = place;
    share[std::size_t(count++)] = weight;
  }
};

/// How q changes along the surface: a step d (metres, world) moves it by (x · d, y · d).
struct PatchGradient {
  Vec3 x = Vec3::Zero(), y = Vec3::Zero();
};

/// With an id map: the patch lies along the tangent frame at its own scale. (The map's jumps from
/// piece to piece of the patch are not its slope.)
PatchGradient patchGradient(const transfer::Patch& patch, const Vec2& rttSize,
                            const Mat3& worldFromPatch);
/// Without: as the texture coordinates run over the triangle; zero where they or it are degenerate.
PatchGradient patchGradient(const transfer::Patch& patch, const scene::Mesh& mesh,
                            std::uint32_t triangle);

/// Between the id map's texels. Each of the four around says where the patch lies at its centre, and
/// goes on from there as the patch does along the surface; those that agree to within a texel are one
/// place, at their mean, with the sum of their bilinear weights. So within a piece of the patch
/// places are smooth, however closely one looks, and where pieces meet each fades into the other
/// over one texel, along a smooth line. Without a map: the one place.
PatchPlaces patchPlaces(const transfer::Patch& patch, const Vec2& uv, const scene::UvSteps& steps,
                        const PatchGradient& gradient);

}  // namespace lambent::shade
