// What must hold between a scene and its transfer, in memory as in a file.
#pragma once

#include <optional>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/asset/summary.h"

namespace lambent::asset {

/// Texels of a grid, each way. A limit for readers: what no bake makes is damage.
inline constexpr int kLargestGrid = 32768;

/// "mesh 3 ("teapot")": how messages name a mesh.
std::string meshLabel(const scene::Scene& scene, std::size_t mesh);

/// The first number that is NaN or infinite.
std::optional<std::size_t> firstNonFinite(const encode::Numbers& numbers);
std::optional<std::size_t> firstNonFinite(std::span<const Vec3> vectors);

/// Shapes and finite numbers of one mesh's transfer against its scene mesh and the bands and RTTs
/// of the whole field. The message names the member and, for a number, its receiver, channel and
/// coefficient; the caller says which mesh.
std::optional<std::string> faultOf(const encode::EncodedMesh& transfer, const scene::Mesh& mesh,
                                   const encode::EncodedField& field);

/// A .glb ends at 4 GiB: asked before anything of such a size is copied.
Status checkSize(const PartBytes& bytes);

/// Everything that read() would refuse, found before an hour's bake is written: ErrorKind::Failed.
Status checkForWriting(const Asset& asset);

}  // namespace lambent::asset
