// Transfer that nothing hides: it takes no bake, and every asset can be shown under it.
#pragma once

#include <cstdint>
#include <memory>

#include "lambent/asset/asset.h"
#include "lambent/transfer/field.h"

namespace lambent::shade {

/// ρ/π Â_l y_i(N) for diffuse receivers and the identity for glossy matrices, with the parts, bands
/// and encodings of what the mesh (a bare surface) holds. The same numbers as a bake of
/// Kind::Unshadowed yields. All threads.
transfer::SurfaceResponse<transfer::Numbers> unshadowedResponse(const asset::Asset& asset,
                                                                std::uint32_t mesh);

/// The response of a bare surface under a kind that it holds, or under Unshadowed, which is made
/// where it is not held. `asset` must outlive it.
std::shared_ptr<const transfer::SurfaceResponse<transfer::Numbers>> responseUnder(
    const asset::Asset& asset, std::uint32_t mesh, transfer::Kind kind);

/// The rotation of harmonics into the tangent frame of every receiver: [receiver][n²][n²], float32
/// where the mesh's own matrices are, otherwise float16. All threads.
transfer::Matrices<transfer::Numbers> rotationsIntoFrames(
    const transfer::BiScale<transfer::Numbers>& biScale, int bands);

}  // namespace lambent::shade
