// The tint of a patch: colours that vary over the surface that carries it, slowly where the patch's
// own vary fast. Exit radiance is the tint times what the patch sends out. It is the base colour
// of the mesh, texture and vertex colours, beside the patch's own reflectance as its factor: so
// other surfaces get light of that colour, and other viewers of the asset show it.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::bi_scale {

/// The patch's colours alone.
struct NoTint {};
/// What the mesh reflects without the patch: its texture, its vertices' colours, and its material's
/// factor, which goes into these.
struct OwnTint {};
/// A picture over the mesh's own UVs.
struct PictureTint {
  int texture = 0;  ///< index into Scene::textures
};
using Tint = std::variant<NoTint, OwnTint, PictureTint>;

/// Gives a mesh of the scene the material of a patch, of that name and reflectance in [0, 1], and
/// leaves of its own what `tint` says; a finding tells what is lost. BadInput where a picture has
/// no UVs to lie over.
Result<Findings> wearPatch(scene::Scene& scene, std::uint32_t mesh, std::string_view name,
                           const Rgb& reflectance, const Tint& tint);

/// What `from` shows by `uvs` (one for each vertex), its alpha too, over the UVs of `mesh`, which lie in the unit
/// square: on as many texels as show it as finely as it is, in the mean over the surface, from
/// `least` to `most` a side. Each is the mean of places within it that triangles hold; those without
/// one are as the nearest that has one. Charts that are two texels apart do not mix.
scene::Texture laidOut(const scene::Texture& from, std::span<const Vec2> uvs,
                       const scene::Mesh& mesh, int least, int most);

}  // namespace lambent::bi_scale
