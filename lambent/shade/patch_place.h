// Where on the patch a place of the surface lies: q(u) of sloan2003biscale §3.
#pragma once

#include <cstdint>

#include "lambent/scene/scene.h"
#include "lambent/transfer/bi_scale.h"

namespace lambent::shade {

/// q, periods of the patch along x and y, each in [0, 1). uv as glTF has it, clamped to the id
/// map's border.
Vec2 patchPlace(const transfer::Patch& patch, const Vec2& uv);

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

}  // namespace lambent::shade
