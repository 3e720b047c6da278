// Patches that lie over another by a mask: each is a layer of the mesh (scene/layers.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lambent/bi_scale/tint.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::bi_scale {

/// Where a picture over a mesh's UVs shows a patch: as far as a channel of it is 1.
struct Mask {
  const scene::Texture& picture;
  int channel = 0;  ///< red, green, blue
};

/// A whole copy of a mesh, to be laid out and then cut to its triangles.
struct Layer {
  std::uint32_t mesh = 0, base = 0;
  std::vector<std::uint32_t> triangles;  ///< that the mask touches
  double share = 0.0;                    ///< of the mesh's surface where it is seen
};

/// Adds a layer of a mesh, which still has its own material, at the end of the scene, with the
/// material of a patch as wearPatch() makes it; its alpha is the mask. None: the mask shows it
/// nowhere. BadInput where the mesh has no UVs.
Result<std::optional<Layer>> addLayer(scene::Scene& scene, std::uint32_t base,
                                      std::string_view name, const Rgb& reflectance,
                                      const Mask& mask, const Tint& tint);

/// The shares of the surface of a mesh that are seen of it and of the layers over it, which all
/// have its UVs still, lowest first.
std::vector<double> sharesSeen(const scene::Scene& scene, std::uint32_t base,
                               std::span<const std::uint32_t> layers);

}  // namespace lambent::bi_scale
